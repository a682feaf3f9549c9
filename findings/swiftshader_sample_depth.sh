#!/usr/bin/env bash
# SwiftShader (Vulkan driver of Chromium, Debian package chromium-common): with four samples per pixel the depth of a sample is that of a
# place which lies the other way round from left to right than the sample does.
#
# Behaviour seen: coverage and the standard pattern agree, the first sample lies at (0.375, 0.125) of a pixel; but the depth that is
# written for it is that of (0.625, 0.125), and so on for the other three. On a surface that slopes from left to right depth is off by up
# to three quarters of a pixel's change. Mesa's lavapipe writes the depth of the place that the sample has.
# A good guess: depth is interpolated at the sample's own place (Vulkan specification, "Standard sample locations"; the driver reports them).
# Who meets it: whoever reads multisampled depth in Chromium without a GPU, and tests that take SwiftShader as a reference.
# Output seen (2026-11-29, chromium-common 156.0.8078.108 of Debian 12, wgpu 30.0.0): depth at x 0.625 0.125 0.875 0.375, left half covers 0 2.
#
# Run by hand: findings/swiftshader_sample_depth.sh. Needs Debian, cargo and a Vulkan loader. Exits with 0 as long as this is so, with 1 if
# it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq -o APT::Sandbox::User=root chromium-common
ls chromium-common_*.deb
mkdir driver src
dpkg-deb --fsys-tarfile chromium-common_*.deb | tar -x -C driver --wildcards './usr/lib/chromium/*swiftshader*'
VK_DRIVER_FILES=$folder/driver/usr/lib/chromium/vk_swiftshader_icd.json
export VK_DRIVER_FILES VK_ICD_FILENAMES=$VK_DRIVER_FILES
cat > Cargo.toml <<'TOML'
[package]
name = "samples"
version = "0.0.0"
edition = "2024"

[workspace]

[dependencies]
pollster = "=0.4.0"
wgpu = { version = "=30.0.0", default-features = false, features = ["std", "vulkan", "wgsl"] }
TOML
cat > src/main.rs <<'RUST'
use pollster::block_on;
use wgpu::*;

const SHADER: &str = "
@vertex fn slope(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    let place = 2.0 * vec2f(f32(i & 1u), f32(i >> 1u));
    return vec4f(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 0.4 * place.x, 1.0);
}
@vertex fn left(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    // The left half of the first of four pixels along x, over all of y.
    let place = vec2f(f32(i & 1u) / 8.0, f32(i >> 1u));
    return vec4f(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 0.25, 1.0);
}
@group(0) @binding(0) var depth: texture_depth_multisampled_2d;
@group(0) @binding(1) var<storage, read_write> found: array<f32, 4>;
@compute @workgroup_size(4) fn read(@builtin(local_invocation_index) i: u32) {
    found[i] = textureLoad(depth, vec2u(0u, 1u), i);
}";

fn main() {
    let instance = Instance::new(InstanceDescriptor::new_without_display_handle());
    let adapter = block_on(instance.request_adapter(&Default::default())).expect("an adapter");
    println!("{}", adapter.get_info().name);
    let (device, queue) = block_on(adapter.request_device(&Default::default())).expect("a device");
    let module = device.create_shader_module(ShaderModuleDescriptor { label: None, source: ShaderSource::Wgsl(SHADER.into()) });
    let depth = device.create_texture(&TextureDescriptor {
        label: None,
        size: Extent3d { width: 4, height: 4, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 4,
        dimension: TextureDimension::D2,
        format: TextureFormat::Depth32Float,
        usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let view = depth.create_view(&Default::default());
    let buffer = |usage| device.create_buffer(&BufferDescriptor { label: None, size: 16, usage, mapped_at_creation: false });
    let (found, read) = (buffer(BufferUsages::STORAGE | BufferUsages::COPY_SRC), buffer(BufferUsages::MAP_READ | BufferUsages::COPY_DST));
    let reader = device.create_compute_pipeline(&ComputePipelineDescriptor {
        label: None, layout: None, module: &module, entry_point: Some("read"), compilation_options: Default::default(), cache: None,
    });
    let group = device.create_bind_group(&BindGroupDescriptor {
        label: None,
        layout: &reader.get_bind_group_layout(0),
        entries: &[
            BindGroupEntry { binding: 0, resource: BindingResource::TextureView(&view) },
            BindGroupEntry { binding: 1, resource: found.as_entire_binding() },
        ],
    });
    let drawn = |entry_point, topology, vertices| -> [f32; 4] {
        let pipeline = device.create_render_pipeline(&RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: VertexState { module: &module, entry_point: Some(entry_point), compilation_options: Default::default(), buffers: &[] },
            primitive: PrimitiveState { topology, ..Default::default() },
            depth_stencil: Some(DepthStencilState {
                format: TextureFormat::Depth32Float, depth_write_enabled: Some(true), depth_compare: Some(CompareFunction::Always),
                stencil: Default::default(), bias: Default::default(),
            }),
            multisample: MultisampleState { count: 4, ..Default::default() },
            fragment: None, multiview_mask: None, cache: None,
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_render_pass(&RenderPassDescriptor {
            depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
                view: &view, depth_ops: Some(Operations { load: LoadOp::Clear(1.0), store: StoreOp::Store }), stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&pipeline);
        pass.draw(0..vertices, 0..1);
        drop(pass);
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&reader);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(1, 1, 1);
        drop(pass);
        encoder.copy_buffer_to_buffer(&found, 0, &read, 0, 16);
        queue.submit([encoder.finish()]);
        read.slice(..).map_async(MapMode::Read, |result| result.expect("the buffer is mapped"));
        device.poll(PollType::wait_indefinitely()).expect("the device is done");
        let bytes = read.slice(..).get_mapped_range().expect("the range is mapped").to_vec();
        read.unmap();
        [0, 1, 2, 3].map(|i| f32::from_le_bytes([bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]]))
    };
    let places = drawn("slope", PrimitiveTopology::TriangleList, 3).map(|z| z / 0.4 * 4.0);
    let covered = drawn("left", PrimitiveTopology::TriangleStrip, 4).map(|z| z == 0.25);
    let covered: Vec<usize> = (0..4).filter(|&i| covered[i]).collect();
    println!("depth at x {places:.3?}, left half covers {covered:?}");
    let mirrored = [0.625, 0.125, 0.875, 0.375];
    let as_found = covered == [0, 2] && (0..4).all(|i| (places[i] - mirrored[i]).abs() < 1e-3);
    println!("{}", if as_found { "as found" } else { "this has changed" });
    std::process::exit(i32::from(!as_found));
}
RUST
cargo run --quiet --release
