#!/usr/bin/env bash
# nightshade-renderer 0.56.0 (Rust, frame graph on wgpu 29): transient textures of other numbers of layers share one.
#
# Behaviour seen: `can_alias_textures` compares format, size, samples, mip levels and usage, and neither layers nor dimension. A transient
# texture of two layers, first used after the last use of one that is equal but for its single layer, is that texture: it has one layer,
# and a view of the second one is refused. Nothing is said when the graph is compiled.
# A good guess: layers and dimension are compared as well.
# Who meets it: whoever registers array textures with `register_transient_resource_fixed`; the builders for colour have no layers.
# Output seen (2026-11-29): asked for 2 layers: given 1 after a texture of 1, 2 after a texture of 2.
#
# Run by hand: findings/nightshade_layers.sh. Needs cargo and a Vulkan driver. Exits with 0 as long as this is so, with 1 if it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'TOML'
[package]
name = "layers"
version = "0.0.0"
edition = "2024"

[workspace]

[dependencies]
nightshade-renderer = { version = "=0.56.0", default-features = false, features = ["rendergraph"] }
pollster = "=0.4.0"
wgpu = { version = "=29.0.4", default-features = false, features = ["std", "vulkan"] }
TOML
cat > "$folder/src/main.rs" <<'RUST'
use std::sync::Mutex;

use nightshade_renderer::rendergraph::{
    self, PassExecutionContext, PassNode, RenderGraphTextureDescriptor, ResourceType,
    SubGraphRunCommand, render_graph_add_pass, render_graph_compile, render_graph_execute,
    render_graph_new, render_graph_resources_mut,
};

/// Layers of the texture that the last pass is given.
static GIVEN: Mutex<u32> = Mutex::new(0);

struct Pass(&'static str, Vec<&'static str>, Vec<&'static str>);

impl PassNode for Pass {
    fn name(&self) -> &str {
        self.0
    }
    fn reads(&self) -> Vec<&str> {
        self.1.clone()
    }
    fn writes(&self) -> Vec<&str> {
        self.2.clone()
    }
    fn execute<'r, 'e>(
        &mut self,
        context: PassExecutionContext<'r, 'e>,
    ) -> rendergraph::Result<Vec<SubGraphRunCommand<'r>>> {
        if self.0 == "last" {
            *GIVEN.lock().unwrap() = context.get_texture("layered")?.depth_or_array_layers();
        }
        Ok(Vec::new())
    }
}

/// The layers that a texture of two layers has, after one of `before` layers.
fn given(device: &wgpu::Device, queue: &wgpu::Queue, before: u32) -> u32 {
    let mut graph = render_graph_new();
    let mut texture = |name: &str, width, layers| {
        let descriptor = RenderGraphTextureDescriptor {
            format: wgpu::TextureFormat::Rgba8Unorm,
            width,
            height: 16,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            sample_count: 1,
            mip_level_count: 1,
            dimension: wgpu::TextureDimension::D2,
            depth_or_array_layers: layers,
        };
        let transient = ResourceType::TransientColor { descriptor, clear_color: None, force_store: false };
        render_graph_resources_mut(&mut graph).register_transient_resource_fixed(name.into(), transient)
    };
    let [first, between, layered] = [texture("first", 16, before), texture("between", 8, 1), texture("layered", 16, 2)];
    let slots = [("first", first), ("between", between), ("layered", layered)];
    let passes = [
        Pass("one", vec![], vec!["first"]),
        Pass("two", vec!["first"], vec!["between"]),
        Pass("three", vec!["between"], vec!["layered"]),
        Pass("last", vec!["layered"], vec![]),
    ];
    for pass in passes {
        render_graph_add_pass(&mut graph, Box::new(pass), &slots).unwrap();
    }
    render_graph_compile(&mut graph).unwrap();
    render_graph_execute(&mut graph, device, queue, &()).unwrap();
    *GIVEN.lock().unwrap()
}

fn main() {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        // Names of debug groups crash lavapipe 22.3.
        flags: wgpu::InstanceFlags::DISCARD_HAL_LABELS,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapter = pollster::block_on(instance.request_adapter(&Default::default())).unwrap();
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default())).unwrap();
    let [after_one, after_two] = [1, 2].map(|before| given(&device, &queue, before));
    println!("asked for 2 layers: given {after_one} after a texture of 1, {after_two} after a texture of 2");
    let as_found = after_one == 1 && after_two == 2;
    println!("{}", if as_found { "as found" } else { "this has changed" });
    std::process::exit(i32::from(!as_found));
}
RUST
cargo run --quiet --manifest-path "$folder/Cargo.toml"
