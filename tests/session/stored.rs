//! The receiver bias knows how coarsely depth is stored: a floor far from a spot's near plane is lit, and what stands on it
//! still casts its shadow.

use glam::DVec3;
use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;
use moment_shadows_lab::frame::{Frame, FrameDesc};
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::light::{LightShape, LightView};
use moment_shadows_lab::scene::{Material, Mesh, Scene};
use moment_shadows_lab::view::Camera;

use crate::{HARD, gpu, imports, places, recorded, session};

/// Wide boards at these heights.
fn boards(heights: &[f32]) -> Scene {
    let mut mesh = Mesh::default();
    for &height in heights {
        let first = mesh.positions.len() as u32;
        for [x, z] in [[-10.0, 10.0], [10.0, 10.0], [10.0, -10.0], [-10.0, -10.0]] {
            mesh.positions.push([x, height, z]);
            mesh.normals.push([0.0, 1.0, 0.0]);
            mesh.uvs.push([0.0; 2]);
        }
        mesh.indices
            .extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    }
    Scene {
        name: "boards".to_owned(),
        meshes: vec![mesh],
        materials: vec![Material::plain("grey", [0.5; 3])],
        ..Scene::default()
    }
}

/// A floor 7.5 units below a spot, within the light's cone.
pub(crate) fn floor(gpu: &Gpu, format: wgpu::TextureFormat, near: f64, board: bool) -> Frame {
    let scene = boards(if board { &[0.0, 2.5] } else { &[0.0] });
    let along = DVec3::new(0.1, -1.0, 0.07).normalize();
    let eye = DVec3::new(0.0, 7.5, 0.0);
    let light = LightView::spot(eye, along, 1.0, near, None, [near, 10.0], false).unwrap();
    let desc = FrameDesc {
        picture: [96, 54],
        map: [256; 2],
        samples: 1,
        format,
        camera_depth: (wgpu::TextureFormat::Depth32Float, 1),
        light,
        shape: LightShape::Directional {
            angular_diameter: 0.0,
        },
        camera: Camera {
            eye: DVec3::new(0.5, 2.0, 0.4),
            target: DVec3::ZERO,
            vertical_angle: 0.7,
            aspect: 96.0 / 54.0,
            near: 0.1,
            far: None,
        },
    };
    Frame::draw(gpu, &scene, desc).unwrap()
}

/// The mean shadow intensity of that floor.
fn mean(gpu: &Gpu, format: wgpu::TextureFormat, near: f64, board: bool) -> f64 {
    let frame = floor(gpu, format, near, board);
    let (camera, light) = places(&frame);
    let mut session = session(gpu, HARD, &imports(&frame));
    session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    let picture = recorded(gpu, &session, 0, "shadow_intensity");
    picture.iter().map(|&byte| f64::from(byte)).sum::<f64>() / (255.0 * picture.len() as f64)
}

#[test]
fn a_floor_far_from_the_near_plane_is_lit_in_every_format() {
    let gpu = gpu();
    for format in TextureFormat::ALL.into_iter().filter(|it| it.is_depth()) {
        let format = TextureDesc::new(format, [1, 1]).wgpu_format();
        for near in [1.0, 0.1, 0.01] {
            let lit = mean(&gpu, format, near, false);
            let shadowed = mean(&gpu, format, near, true);
            println!("{format:?}, near plane {near}: {lit:.4} lit, {shadowed:.4} below a board");
            assert!(lit <= 0.02, "{format:?} {near}: {lit}");
            assert!(shadowed >= 0.95, "{format:?} {near}: {shadowed}");
        }
    }
}
