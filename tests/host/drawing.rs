//! What is rendered, and what is read back.

use glam::{DVec2, DVec3};
use moment_shadows::Profile;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::host::{
    DepthMap, DepthMapDesc, Lighting, Renderer, Surface, read_depth_samples, read_gbuffer,
};
use moment_shadows_lab::light::LightView;
use moment_shadows_lab::scene::{self, Image, Material, Mesh, Scene};
use moment_shadows_lab::view::View;
use wgpu::TextureFormat::{Depth16Unorm, Depth32Float, Rgba8Unorm};

fn vector(value: [f32; 3]) -> DVec3 {
    DVec3::from_array(value.map(f64::from))
}

/// A scene drawn once: from the light and from the camera.
struct Drawn {
    map: DepthMap,
    surface: Surface,
}

fn draw(
    gpu: &Gpu,
    renderer: &Renderer,
    scene: &Scene,
    view: &View,
    light: &LightView,
    desc: DepthMapDesc,
) -> Drawn {
    let model = renderer.upload(gpu, scene).unwrap();
    let map = renderer.depth_map(gpu, &desc).unwrap();
    let surface = renderer.surface(gpu, [320, 180]).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    renderer.draw_depth(gpu, &mut encoder, &model, &map, light.clip_from_world());
    renderer
        .draw_surface(gpu, &mut encoder, &model, &surface, &view.camera)
        .unwrap();
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
    Drawn { map, surface }
}

#[test]
fn light_depth_agrees_with_the_surfaces_that_the_camera_sees() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let renderer = Renderer::new(&gpu).unwrap();
    let scene = scene::load("fence-and-foliage").unwrap();
    let view = View::numbered(&scene, 0);
    let size = [512, 256];
    // Rounding of what is stored, as moment depth: half a step of 2 / 65535 for unorm16; for floats the rasteriser's
    // f32 arithmetic on lengths that are 10 times the smallest ones. Forward hyperbolic depth with its near plane at
    // a tenth of the distance divides by a slope of about a tenth.
    for (light, format, tolerance) in [
        (
            view.sun(&scene, size, 8.0, false).unwrap(),
            Depth32Float,
            1e-5,
        ),
        (
            view.sun(&scene, size, 8.0, true).unwrap(),
            Depth32Float,
            1e-5,
        ),
        (
            view.sun(&scene, size, 8.0, false).unwrap(),
            Depth16Unorm,
            3e-5,
        ),
        (
            view.spot(&scene, 1e-4, None, true).unwrap(),
            Depth32Float,
            1e-5,
        ),
        (
            view.spot(&scene, 0.1, Some(40.0), false).unwrap(),
            Depth32Float,
            1e-4,
        ),
    ] {
        let desc = DepthMapDesc {
            size,
            samples: 1,
            format,
            reversed: light.depth.reversed(),
        };
        let drawn = draw(&gpu, &renderer, &scene, &view, &light, desc);
        let depth = read_depth_samples(&gpu, &drawn.map.texture).unwrap();
        let pixels = read_gbuffer(&gpu, &drawn.surface).unwrap();
        let [mut lit, mut shadowed, mut wrong] = [0, 0, 0];
        for (index, _) in pixels
            .covered
            .iter()
            .enumerate()
            .filter(|(_, covered)| **covered)
        {
            let position = vector(pixels.position[index]);
            // Only the ground: its plane is known exactly, so the depth at the texel's centre is too.
            if position.y.abs() > 1e-5 {
                continue;
            }
            let extent = DVec2::new(f64::from(size[0]), f64::from(size[1]));
            let Some(uv) = light.uv(position) else {
                continue;
            };
            if uv.min_element() < 0.0 || uv.max_element() >= 1.0 {
                continue;
            }
            let texel = (uv * extent).floor();
            let (origin, direction) = light.ray((texel + 0.5) / extent);
            let point = origin - origin.y / direction.y * direction;
            let at = texel.y as usize * size[0] as usize + texel.x as usize;
            let stored = light.moment_depth_of_stored(f64::from(depth.values[at]));
            let difference = stored - light.moment_depth(point).clamp(-1.0, 1.0);
            if difference.abs() < tolerance {
                lit += 1;
            } else if difference < 0.0 {
                shadowed += 1;
            } else {
                wrong += 1;
            }
        }
        // Nothing lies below the ground, so nothing may be deeper than it.
        assert_eq!(
            wrong, 0,
            "{:?} {format:?}: deeper than the ground",
            light.depth
        );
        assert!(
            lit > 2000 && shadowed > 500,
            "{:?}: {lit} {shadowed}",
            light.depth
        );
    }
}

#[test]
fn positions_and_normals_are_those_of_the_pixel() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let renderer = Renderer::new(&gpu).unwrap();
    let scene = scene::load("hall").unwrap();
    let view = View::numbered(&scene, 0);
    let light = view.sun(&scene, [64, 64], 4.0, false).unwrap();
    let desc = DepthMapDesc {
        size: [64, 64],
        samples: 1,
        format: Depth32Float,
        reversed: false,
    };
    let drawn = draw(&gpu, &renderer, &scene, &view, &light, desc);
    let pixels = read_gbuffer(&gpu, &drawn.surface).unwrap();
    let clip_from_world = view.camera.clip_from_world().unwrap();
    let mut covered = 0;
    for index in 0..pixels.covered.len() {
        let position = vector(pixels.position[index]);
        let normal = vector(pixels.normal[index]);
        if !pixels.covered[index] {
            assert_eq!((position, normal), (DVec3::ZERO, DVec3::ZERO));
            continue;
        }
        covered += 1;
        let clip = clip_from_world * position.extend(1.0);
        let x = (0.5 + 0.5 * clip.x / clip.w) * f64::from(pixels.width);
        let y = (0.5 - 0.5 * clip.y / clip.w) * f64::from(pixels.height);
        let centre = [index as u32 % pixels.width, index as u32 / pixels.width]
            .map(|at| f64::from(at) + 0.5);
        // Rasterisers place vertices on a grid of 1/256 of a pixel, and a triangle may be seen edge-on.
        assert!(
            (x - centre[0]).abs() < 0.1 && (y - centre[1]).abs() < 0.1,
            "{x} {y} {centre:?}"
        );
        // Three halves round the length by at most 2^-11.
        assert!((normal.length() - 1.0).abs() < 1e-3, "{normal}");
        assert!(normal.dot(view.camera.eye - position) > -1e-2 * position.length());
    }
    assert!(covered > 40_000, "{covered}");
}

#[test]
fn impossible_maps_are_refused() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let renderer = Renderer::new(&gpu).unwrap();
    let desc = DepthMapDesc {
        size: [64, 32],
        samples: 1,
        format: Depth32Float,
        reversed: false,
    };
    let refused = |desc: DepthMapDesc| match renderer.depth_map(&gpu, &desc) {
        Ok(_) => panic!("{desc:?} was made"),
        Err(error) => error,
    };
    for samples in [0, 2, 3, 8] {
        let error = refused(DepthMapDesc { samples, ..desc });
        let text = error.to_string();
        let expected = format!("Depth32Float with {samples} samples");
        assert!(
            text.contains(&expected) && text.contains("supports [1, 4]"),
            "{text}"
        );
    }
    let error = refused(DepthMapDesc {
        format: Rgba8Unorm,
        ..desc
    });
    assert!(
        error.to_string().contains("rendered as Rgba8Unorm"),
        "{error}"
    );
    for size in [[0, 32], [64, 1 << 20]] {
        let error = refused(DepthMapDesc { size, ..desc });
        assert!(
            error.to_string().contains("depth map would have"),
            "{error}"
        );
    }
    gpu.check().unwrap();
}

/// A square of 2 m above the ground, seen through by rows of holes: the alpha of its texture.
fn masked_square(alpha: u8) -> Scene {
    let material = Material {
        texture: Some(0),
        mask: Some(0.5),
        ..Material::plain("screen", [1.0; 3])
    };
    scene::place_on_ground(Scene {
        name: "screen".to_owned(),
        meshes: vec![Mesh {
            positions: vec![
                [-1.0, 1.0, -1.0],
                [-1.0, 1.0, 1.0],
                [1.0, 1.0, 1.0],
                [1.0, 1.0, -1.0],
            ],
            normals: vec![[0.0, 1.0, 0.0]; 4],
            uvs: vec![[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]],
            indices: vec![0, 1, 2, 0, 2, 3],
            ..Mesh::default()
        }],
        materials: vec![material],
        images: vec![Image {
            width: 2,
            height: 2,
            rgba: [255, 255, 255, alpha].repeat(4),
        }],
        ..Scene::default()
    })
}

#[test]
fn samples_are_read_apart_and_masks_leave_holes() {
    let gpu = Gpu::open(Profile::NativeAdapter).unwrap();
    let renderer = Renderer::new(&gpu).unwrap();
    for (alpha, samples) in [(255, 1), (255, 4), (0, 4)] {
        let mut scene = masked_square(alpha);
        scene.meshes.retain(|mesh| !mesh.ground);
        let view = View::numbered(&scene, 0);
        let light = view.sun(&scene, [64, 64], 8.0, true).unwrap();
        let desc = DepthMapDesc {
            size: [64, 64],
            samples,
            format: Depth32Float,
            reversed: true,
        };
        let drawn = draw(&gpu, &renderer, &scene, &view, &light, desc);
        let depth = read_depth_samples(&gpu, &drawn.map.texture).unwrap();
        assert_eq!(depth.values.len(), 64 * 64 * samples as usize);
        let far = depth.values.iter().filter(|&&value| value == 0.0).count();
        if alpha == 0 {
            assert_eq!(far, depth.values.len());
            continue;
        }
        assert!(far > 0 && far < depth.values.len());
        // Reversed: the square's near edge is stored as nearly 1, less what the ground before it takes.
        let largest = depth.values.iter().copied().fold(0.0, f32::max);
        assert!(largest > 0.75 && largest <= 1.0, "{largest}");
        let mixed = depth
            .values
            .chunks(samples as usize)
            .filter(|texel| texel.contains(&0.0) && texel.iter().any(|&value| value > 0.0))
            .count();
        // Along the outline samples differ; one sample cannot.
        assert_eq!(mixed > 0, samples > 1);
    }
}

#[test]
fn shadow_intensity_darkens_the_picture() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let renderer = Renderer::new(&gpu).unwrap();
    let scene = masked_square(255);
    let view = View::numbered(&scene, 0);
    let light = view.sun(&scene, [64, 64], 4.0, false).unwrap();
    let desc = DepthMapDesc {
        size: [64, 64],
        samples: 1,
        format: Depth32Float,
        reversed: false,
    };
    let drawn = draw(&gpu, &renderer, &scene, &view, &light, desc);
    let lighting = Lighting::new(&scene, &view.camera, &light).unwrap();
    let shaded = |size: [u32; 2], intensity: f64| {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let shadow = texture.create_view(&Default::default());
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &shadow,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color {
                        r: intensity,
                        ..wgpu::Color::BLACK
                    }),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        let picture = renderer.shade(&gpu, &mut encoder, &drawn.surface, &shadow, &lighting)?;
        gpu.queue.submit([encoder.finish()]);
        gpu.read_texture(&picture, 0, "picture")
    };
    let lit = shaded([320, 180], 0.0).unwrap();
    let shadowed = shaded([320, 180], 1.0).unwrap();
    // The bottom middle of the picture is ground, the top is sky.
    let [sky, ground] = [160, 320 * 179 + 160].map(|pixel| pixel * 4);
    assert_eq!(lit[sky..sky + 4], shadowed[sky..sky + 4]);
    assert!(
        lit[ground] > shadowed[ground] + 40,
        "{} {}",
        lit[ground],
        shadowed[ground]
    );
    let error = shaded([64, 64], 0.0).unwrap_err();
    assert!(error.to_string().contains("64x64"), "{error}");
}
