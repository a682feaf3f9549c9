//! The reference host: lights, viewpoints, what is rendered, and pictures.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::io::{Error, ErrorKind, Write};

use glam::{DVec2, DVec3};
use moment_shadows::Profile;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::host::{
    HostError, LightMap, LightMapDesc, Lighting, Renderer, Surface, read_depth_samples,
    read_gbuffer,
};
use moment_shadows_lab::light::{DirectionalFit, LightError, LightView};
use moment_shadows_lab::picture::{self, PictureError};
use moment_shadows_lab::scene::{self, Image, Material, Mesh, Scene};
use moment_shadows_lab::view::View;
use wgpu::TextureFormat::{Depth16Unorm, Depth24Plus, Depth32Float};

fn vector(value: [f32; 3]) -> DVec3 {
    DVec3::from_array(value.map(f64::from))
}

/// A spot light of every way to store depth, and the sun of a viewpoint both ways.
fn lights(scene: &Scene, view: &View) -> Vec<LightView> {
    let mut lights = Vec::new();
    for reversed in [false, true] {
        lights.push(view.sun(scene, [512, 256], 8.0, reversed).unwrap());
        for far in [Some(40.0), None] {
            lights.push(view.spot(scene, 0.1, far, reversed).unwrap());
        }
    }
    lights
}

#[test]
fn a_fitted_sun_covers_all_casters_and_leaves_its_margin() {
    let map = [1024, 512];
    for name in scene::PROCEDURAL {
        let scene = scene::load(name).unwrap();
        for number in 0..6 {
            let view = View::numbered(&scene, number);
            let sun = view.sun(&scene, map, 12.0, false).unwrap();
            let margin = DVec2::new(12.0 / 1024.0, 12.0 / 512.0);
            let mut low = DVec2::ONE;
            let mut high = DVec2::ZERO;
            for point in scene.casters() {
                let uv = sun.uv(point).unwrap();
                low = low.min(uv);
                high = high.max(uv);
                assert!(
                    sun.moment_depth(point).abs() <= 1.0,
                    "{name} {number}: {point}"
                );
            }
            // Tight: the outermost casters touch the margin, up to rounding in f64.
            assert!(
                (low - margin).abs().max_element() < 1e-9,
                "{name} {number}: {low}"
            );
            assert!(
                (1.0 - high - margin).abs().max_element() < 1e-9,
                "{name} {number}: {high}"
            );
            // In depth they leave 1/1000 before the first and 1/16 behind the last, of the casters' depth.
            let [mut nearest, mut farthest] = [1.0f64, -1.0f64];
            for depth in scene.casters().map(|point| sun.moment_depth(point)) {
                nearest = nearest.min(depth);
                farthest = farthest.max(depth);
            }
            let casters = farthest - nearest;
            assert!(
                (nearest + 1.0 - 1e-3 * casters).abs() < 1e-9
                    && (1.0 - farthest - casters / 16.0).abs() < 1e-9,
                "{name} {number}: {nearest} {farthest}"
            );
        }
    }
}

#[test]
fn uv_rays_and_stored_depth_agree_with_the_clip_matrices() {
    let scene = scene::load("hall").unwrap();
    for light in lights(&scene, &View::numbered(&scene, 1)) {
        for uv in [[0.5, 0.5], [0.1, 0.3], [0.95, 0.9]].map(DVec2::from_array) {
            for part in [0.001, 0.3, 0.999] {
                let distance = light.range[0] + part * (light.range[1] - light.range[0]);
                let (origin, direction) = light.ray(uv);
                let point = origin + distance * direction;
                // Lengths are some 100 m in f64, so 1e-9 is generous for rounding.
                assert!((light.distance(point) - distance).abs() < 1e-9);
                assert!((light.uv(point).unwrap() - uv).length() < 1e-9);
                let depth = light.moment_depth(point);
                assert!((depth - (2.0 * part - 1.0)).abs() < 1e-9);
                let clip = light.clip_from_world() * point.extend(1.0);
                let stored = clip.z / clip.w;
                // Hyperbolic depth loses up to far/near digits when it is inverted.
                let error = (light.moment_depth_of_stored(stored) - depth).abs();
                assert!(error < 1e-8, "{:?}: {error}", light.depth);
            }
        }
        assert_eq!(light.moment_depth_of_stored(f64::NAN), 1.0);
        assert_eq!(light.moment_depth_of_stored(light.depth.cleared()), 1.0);
        let near = if light.depth.reversed() { 7.0 } else { -7.0 };
        assert_eq!(light.moment_depth_of_stored(near), -1.0);
        let axis = light.towards_light(DVec3::ZERO);
        let behind = light.ray(DVec2::splat(0.5)).0 + 200.0 * axis;
        assert_eq!(light.uv(behind).is_none(), light.range[0] > 0.0);
    }
}

#[test]
fn lights_that_cannot_be_are_refused() {
    let fit = DirectionalFit {
        map: [64, 64],
        margin: 4.0,
        reversed: false,
    };
    let points = [DVec3::ZERO, DVec3::ONE];
    let sun = LightView::directional_fitted;
    let spot = |angle, near, far, range| {
        LightView::spot(DVec3::Y, DVec3::NEG_Y, angle, near, far, range, false)
    };
    type Row = (
        Result<LightView, LightError>,
        fn(&LightError) -> bool,
        &'static str,
    );
    let rows: [Row; 11] = [
        (
            sun(DVec3::ZERO, &points, fit),
            |error| matches!(error, LightError::Direction { .. }),
            "[0.0, 0.0, 0.0]",
        ),
        (
            sun(DVec3::NAN, &points, fit),
            |error| matches!(error, LightError::Direction { .. }),
            "NaN",
        ),
        (
            sun(DVec3::NEG_Y, &[], fit),
            |error| matches!(error, LightError::NoCasters),
            "no casters",
        ),
        (
            sun(DVec3::NEG_Y, &[DVec3::ZERO, DVec3::INFINITY], fit),
            |error| matches!(error, LightError::Caster { index: 1, .. }),
            "caster point 1",
        ),
        (
            sun(
                DVec3::NEG_Y,
                &points,
                DirectionalFit {
                    margin: 32.0,
                    ..fit
                },
            ),
            |error| matches!(error, LightError::Margin { .. }),
            "64x64",
        ),
        (
            spot(0.0, 0.1, None, [0.1, 1.0]),
            |error| matches!(error, LightError::Angle { .. }),
            "0 radians",
        ),
        (
            spot(3.2, 0.1, None, [0.1, 1.0]),
            |error| matches!(error, LightError::Angle { .. }),
            "3.2",
        ),
        (
            spot(1.0, 0.0, None, [0.1, 1.0]),
            |error| {
                matches!(
                    error,
                    LightError::Interval {
                        what: "depth planes",
                        ..
                    }
                )
            },
            "from 0 ",
        ),
        (
            spot(1.0, 2.0, Some(1.0), [0.1, 1.0]),
            |error| {
                matches!(
                    error,
                    LightError::Interval {
                        what: "depth planes",
                        ..
                    }
                )
            },
            "from 2 to 1",
        ),
        (
            spot(1.0, f64::NAN, Some(1.0), [0.1, 1.0]),
            |error| {
                matches!(
                    error,
                    LightError::Interval {
                        what: "depth planes",
                        ..
                    }
                )
            },
            "NaN",
        ),
        (
            spot(1.0, 0.1, None, [0.1, f64::INFINITY]),
            |error| {
                matches!(
                    error,
                    LightError::Interval {
                        what: "moment range",
                        ..
                    }
                )
            },
            "moment range",
        ),
    ];
    for (result, is_expected, culprit) in rows {
        let error = result.unwrap_err();
        assert!(is_expected(&error), "{error:?}");
        assert!(
            error.to_string().contains(culprit),
            "'{error}' lacks '{culprit}'"
        );
    }
    // Degenerate but possible: one point, and straight down.
    let light = sun(DVec3::NEG_Y, &points[..1], fit).unwrap();
    assert!((light.uv(DVec3::ZERO).unwrap() - 0.5).length() < 1e-9);
    assert!(light.moment_depth(DVec3::ZERO).abs() <= 1.0);
}

#[test]
fn viewpoints_are_numbered() {
    let scene = scene::load("fence-and-foliage").unwrap();
    let views: Vec<View> = (0..8)
        .map(|number| View::numbered(&scene, number))
        .collect();
    for (number, view) in (0..8).zip(&views) {
        assert_eq!(*view, View::numbered(&scene, number));
        assert!(views.iter().filter(|other| *other == view).count() == 1);
        assert!(view.light_direction.is_normalized());
    }
    // A low sun: 25 to 30 degrees.
    let elevation = (-views[0].light_direction.y).asin().to_degrees();
    assert!((25.0..30.0).contains(&elevation), "{elevation}");
}

/// A scene drawn once: from the light and from the camera.
struct Drawn {
    map: LightMap,
    surface: Surface,
}

fn draw(
    gpu: &Gpu,
    renderer: &Renderer,
    scene: &Scene,
    view: &View,
    light: &LightView,
    desc: LightMapDesc,
) -> Drawn {
    let model = renderer.upload(gpu, scene).unwrap();
    let map = renderer.light_map(gpu, &desc).unwrap();
    let surface = renderer.surface(gpu, [320, 180]).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    renderer.draw_light_depth(gpu, &mut encoder, &model, &map, light);
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
        let desc = LightMapDesc {
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
    let desc = LightMapDesc {
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
    let desc = LightMapDesc {
        size: [64, 32],
        samples: 1,
        format: Depth32Float,
        reversed: false,
    };
    let refused = |desc: LightMapDesc| match renderer.light_map(&gpu, &desc) {
        Ok(_) => panic!("{desc:?} was made"),
        Err(error) => error,
    };
    for samples in [0, 2, 3, 8] {
        let error = refused(LightMapDesc { samples, ..desc });
        assert!(
            matches!(&error, HostError::Samples { asked, supported, .. } if *asked == samples && supported == &[1, 4]),
            "{error:?}"
        );
        assert!(error.to_string().contains("Depth32Float"), "{error}");
    }
    let error = refused(LightMapDesc {
        format: Depth24Plus,
        ..desc
    });
    assert!(matches!(error, HostError::Format { .. }), "{error:?}");
    assert!(error.to_string().contains("Depth24Plus"), "{error}");
    for size in [[0, 32], [64, 1 << 20]] {
        let error = refused(LightMapDesc { size, ..desc });
        assert!(matches!(error, HostError::Size { .. }), "{error:?}");
        assert!(error.to_string().contains("depth map"), "{error}");
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
            material: 0,
            ground: false,
        }],
        materials: vec![material],
        images: vec![Image {
            width: 2,
            height: 2,
            rgba: [255, 255, 255, alpha].repeat(4),
        }],
        ground: None,
        stand: None,
        warnings: Vec::new(),
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
        let desc = LightMapDesc {
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
    let desc = LightMapDesc {
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
        Ok::<_, HostError>(gpu.read_texture(&picture, 0, "picture")?)
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
    assert!(matches!(error, HostError::ShadowSize { .. }), "{error:?}");
    assert!(error.to_string().contains("64x64"), "{error}");
}

#[test]
fn a_picture_is_saved_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("result.png");
    picture::save_grey(&path, 2, 1, &[0, 255]).unwrap();
    let before = std::fs::read(&path).unwrap();
    assert!(before.starts_with(b"\x89PNG"));
    type Failing = fn(&mut dyn Write) -> std::io::Result<()>;
    type Row = (Failing, fn(&PictureError) -> bool, &'static str);
    let rows: [Row; 2] = [
        (
            |file| {
                file.write_all(b"half of it")?;
                Err(Error::from(ErrorKind::StorageFull))
            },
            |error| matches!(error, PictureError::DiskFull { .. }),
            "disk is full",
        ),
        (
            |_| Err(Error::from(ErrorKind::PermissionDenied)),
            |error| matches!(error, PictureError::Unwritable { .. }),
            "permission denied",
        ),
    ];
    for (write, is_expected, culprit) in rows {
        let error = picture::save_atomically(&path, write).unwrap_err();
        assert!(is_expected(&error), "{error:?}");
        let text = error.to_string();
        assert!(
            text.contains(culprit) && text.contains("result.png"),
            "{text}"
        );
    }
    let error = picture::save_rgba(&path, 2, 2, &[0; 4]).unwrap_err();
    assert!(
        matches!(error, PictureError::Size { values: 4, .. }),
        "{error:?}"
    );
    assert_eq!(std::fs::read(&path).unwrap(), before);
    assert_eq!(
        std::fs::read_dir(folder.path()).unwrap().count(),
        1,
        "a part was left behind"
    );

    let error = picture::save_grey(&folder.path().join("absent/a.png"), 1, 1, &[0]).unwrap_err();
    assert!(
        matches!(error, PictureError::MissingFolder { .. }),
        "{error:?}"
    );
    assert!(error.to_string().contains("absent"), "{error}");
    // Neither a file as a folder nor a folder as a file.
    for target in [path.join("a.png"), folder.path().to_owned()] {
        let error = picture::save_grey(&target, 1, 1, &[0]).unwrap_err();
        assert!(
            matches!(error, PictureError::Unwritable { .. }),
            "{error:?}"
        );
        assert!(
            error.to_string().contains(&target.display().to_string()),
            "{error}"
        );
    }
    assert_eq!(std::fs::read(&path).unwrap(), before);
    // Replacing is possible.
    picture::save_rgba(&path, 1, 1, &[1, 2, 3, 255]).unwrap();
    assert_ne!(std::fs::read(&path).unwrap(), before);
}

#[test]
fn differences_are_red_where_too_dark_and_blue_where_too_light() {
    let found = [0.5, 1.0, 0.0, 0.6, f32::NAN];
    let truth = [0.5, 0.0, 1.0, 0.5, 0.5];
    let colours = picture::signed_difference(&found, &truth, 0.2);
    let expected = [
        [255, 255, 255, 255],
        [255, 0, 0, 255],
        [0, 0, 255, 255],
        [255, 128, 128, 255],
        [0, 0, 0, 255],
    ];
    for (index, (colour, expected)) in colours.chunks(4).zip(expected).enumerate() {
        // 0.6 - 0.5 in f32 may round the half step either way.
        let distance = colour
            .iter()
            .zip(expected)
            .map(|(a, b): (&u8, u8)| a.abs_diff(b))
            .max();
        assert!(distance <= Some(1), "{index}: {colour:?}");
    }
    assert_eq!(
        picture::grey(&[0.0, 0.5, 1.0, 2.0, -1.0, f32::NAN]),
        [0, 128, 255, 255, 0, 0]
    );
}
