#!/usr/bin/env bash
# Bevy 0.20.1: volumetric fog is too thin away from the camera's axis.
#
# Behaviour seen: a wall ten metres ahead is seen through fog that takes 5 % of the light per metre and scatters all of it, with the same
# phase for all directions. The fog before the wall is as bright in the picture's corner as in its middle, however many steps are marched.
# A good guess: the way through the fog to a wall at 10 m is 13.1 m long in the corner of a picture of 16 : 9 at 45 degrees, so the fog is
# (1 - e^-0.656) / (1 - e^-0.5) = 1.22 times as bright there. volumetric_fog.wesl subtracts depths along the axis and marches
# that length along the ray.
# Who meets it: games with volumetric fog; the fog gets thinner where the camera turns away, most with wide angles.
# Output seen (2026-11-29): corner over middle: 1.00, expected 1.22.
#
# Run by hand: findings/bevy_fog_length.sh. Needs cargo (Rust 1.95), a Vulkan driver, and some ten minutes for Bevy. Exits with 0 as long as
# this is so, with 1 if it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'TOML'
[package]
name = "fog"
version = "0.0.0"
edition = "2024"

[workspace]

[dependencies]
bevy = { version = "=0.20.1", default-features = false, features = [
    "std", "async_executor", "bevy_log", "bevy_asset", "bevy_render", "bevy_core_pipeline", "bevy_pbr", "bevy_winit", "png", "x11",
] }

[profile.release]
opt-level = 0

[profile.release.package.naga]
opt-level = 1

[profile.release.package.wesl]
opt-level = 1
TOML
cat > "$folder/src/main.rs" <<'RUST'
use bevy::camera::RenderTarget;
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::light::{CascadeShadowConfigBuilder, FogVolume, VolumetricFog, VolumetricLight};
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::window::ExitCondition;

fn linear(value: u8) -> f32 {
    Color::srgb_u8(value, value, value).to_linear().red
}

fn main() {
    let mut app = App::new();
    let window = WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() };
    let render = RenderPlugin { synchronous_pipeline_compilation: true, ..default() };
    app.add_plugins(DefaultPlugins.set(window).set(render).disable::<bevy::winit::WinitPlugin>());
    app.insert_resource(ClearColor(Color::BLACK));
    let target = Image::new_target_texture(320, 180, TextureFormat::Rgba8UnormSrgb, None);
    let target = app.world_mut().resource_mut::<Assets<Image>>().add(target);
    let wall = app.world_mut().resource_mut::<Assets<Mesh>>().add(Cuboid::new(60.0, 60.0, 1.0));
    let black = StandardMaterial { base_color: Color::BLACK, unlit: true, ..default() };
    let black = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(black);
    let world = app.world_mut();
    world.spawn((Mesh3d(wall), MeshMaterial3d(black), Transform::from_xyz(0.0, 0.0, -10.5)));
    world.spawn((
        Camera3d::default(),
        RenderTarget::Image(target.clone().into()),
        Transform::default(),
        Tonemapping::None,
        DebandDither::Disabled,
        Msaa::Off,
        VolumetricFog { ambient_intensity: 0.0, step_count: 512, ..default() },
    ));
    // From behind the camera: the wall shadows no air before it.
    world.spawn((
        DirectionalLight { illuminance: 6000.0, shadow_maps_enabled: true, ..default() },
        CascadeShadowConfigBuilder { num_cascades: 1, maximum_distance: 40.0, ..default() }.build(),
        VolumetricLight,
        Transform::from_xyz(0.0, 1.0, 2.0).looking_at(Vec3::ZERO, Vec3::Y),
    ));
    world.spawn((
        FogVolume { density_factor: 1.0, absorption: 0.0, scattering: 0.05, scattering_asymmetry: 0.0, light_intensity: 13.0, ..default() },
        Transform::from_scale(Vec3::splat(60.0)),
    ));
    app.finish();
    app.cleanup();
    for frame in 0..40 {
        if frame == 8 {
            app.world_mut().spawn(Screenshot::image(target.clone())).observe(|captured: On<ScreenshotCaptured>| {
                let picture = captured.image.clone().try_into_dynamic().unwrap().to_rgb8();
                let at = |x, y| linear(picture.get_pixel(x, y).0[0]);
                println!("{:.2}", at(2, 2) / at(160, 90));
            });
        }
        app.update();
    }
}
RUST
cargo build --quiet --release --ignore-rust-version --manifest-path "$folder/Cargo.toml" --target-dir "${CARGO_TARGET_DIR:-$folder/target}"
ratio=$("${CARGO_TARGET_DIR:-$folder/target}/release/fog" 2>"$folder/said" | tail -n 1)
echo "corner over middle: $ratio, expected 1.22"
if [ -z "$ratio" ]; then cat "$folder/said" >&2; fi
[ "$ratio" = 1.00 ]
