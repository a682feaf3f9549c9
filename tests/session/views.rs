//! Cascades and the faces of a point light, as the core crate makes them: no border is to be seen. Each pixel is that of a view
//! whose borders are far away: the same texels with ten times the guard band.

use glam::{DMat4, DVec3};
use moment_shadows::{
    Atlas, Border, CameraView, CascadeSplits, Cascades, DepthRange, LightDepth, LightView,
    MapRegion, PointLight, TextureFormat, Tile,
};
use moment_shadows_lab::frame::{Frame, FrameDesc};
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::light::LightView as Sun;
use moment_shadows_lab::scene::{Material, Mesh, Scene};
use moment_shadows_lab::view::Camera;

use crate::normals::texture;
use crate::stored::floor;
use crate::{FITTED, HARD, gpu, imports, places, recorded, session};

/// Texels between the guard bands, and the radius of the graph's blur.
const INNER: u32 = 128;
const RADIUS: u32 = 4;

const LAMP: DVec3 = DVec3::new(0.0, 4.0, 0.0);

/// Boards above a floor, each at a height, in rows whose shadows lie across every border.
fn board_at(point: DVec3) -> bool {
    let part = (1.7 * point).fract_gl();
    part.x < 0.45 && part.z < 0.45
}

/// How far a ray goes until it meets the boards one unit above the floor, or the floor.
fn distance(origin: DVec3, along: DVec3) -> f64 {
    let to = |height: f64| {
        let t = (height - origin.y) / along.y;
        (t > 0.0).then_some(t)
    };
    let board = to(1.0).filter(|t| board_at(origin + *t * along));
    board.or(to(0.0)).unwrap_or(1e6)
}

/// The depth map that a host would draw for these views.
fn drawn(gpu: &Gpu, size: [u32; 2], views: &[LightView]) -> wgpu::Texture {
    let texels = depths(size, views);
    texture(
        gpu,
        TextureFormat::R32Float,
        size,
        bytemuck::cast_slice(&texels),
    )
}

/// Its texels.
pub(crate) fn depths(size: [u32; 2], views: &[LightView]) -> Vec<f32> {
    let mut texels = vec![f32::INFINITY; (size[0] * size[1]) as usize];
    for view in views {
        let clip = DMat4::from_cols_array_2d(&view.clip_from_world);
        let inverse = clip.inverse();
        let MapRegion { origin, extent } = view.region;
        for y in 0..extent[1] {
            for x in 0..extent[0] {
                let at = |texel: u32, axis: usize| {
                    2.0 * (f64::from(texel) + 0.5) / f64::from(extent[axis]) - 1.0
                };
                let at = |depth| inverse.project_point3(DVec3::new(at(x, 0), -at(y, 1), depth));
                let [first, last] = [at(0.25), at(0.75)];
                let along = last - first;
                let parallel = matches!(view.depth, LightDepth::Orthographic { .. });
                let start = if parallel { first - 1e3 * along } else { LAMP };
                let hit = start + distance(start, along) * along;
                let hit = clip * hit.extend(1.0);
                // Casters in front of the near plane are clamped there.
                let stored = if parallel {
                    hit.z.clamp(0.0, 1.0)
                } else {
                    hit.w
                };
                texels[((origin[1] + y) * size[0] + origin[0] + x) as usize] = stored as f32;
            }
        }
    }
    texels
}

/// What a session shows of views that are placed.
fn shaded(
    gpu: &Gpu,
    frame: &Frame,
    camera: &CameraView,
    size: [u32; 2],
    views: &[LightView],
) -> Vec<f32> {
    shaded_by(HARD, gpu, frame, camera, size, views)
}

/// A graph like that of hard shadows for views in a map of single precision.
pub(crate) fn graph_of(graph: &str, views: &[LightView]) -> String {
    let count = views.len();
    let import =
        format!(r#""texture": {{ "format": "r32float", "size": [64, 64], "regions": {count} }}"#);
    let depth = r#""texture": { "format": "depth32float", "size": [1024, 1024], "samples": 4 }"#;
    let borders = views.iter().any(|view| view.border != Border::Sharp);
    let debug = if graph.contains("shade.debug") {
        r#", "debug": "view""#
    } else {
        ""
    };
    let shade = format!(
        r#""type": "shade_hard", "properties": {{ "format": "r32float", "views": {count}, "borders": {borders}{debug} }}"#
    );
    let storage = r#""storage": ["unorm16", "float16"]"#;
    graph
        .replace(depth, &import)
        .replace(storage, r#""storage": "float32""#)
        .replace(r#""type": "shade_hard""#, &shade)
}

/// What a session of a graph like that of hard shadows shows.
fn shaded_by(
    graph: &str,
    gpu: &Gpu,
    frame: &Frame,
    camera: &CameraView,
    size: [u32; 2],
    views: &[LightView],
) -> Vec<f32> {
    let text = graph_of(graph, views);
    let map = drawn(gpu, size, views);
    let mut imports = imports(frame);
    imports[0].1 = (&map).into();
    let mut session = session(gpu, &text, &imports);
    session.view(&gpu.queue, 0, camera, views).unwrap();
    bytemuck::pod_collect_to_vec(&recorded(gpu, &session, 0, "shadow_intensity"))
}

/// A tile with a guard band of `guard` texels.
fn tile(guard: u32) -> Tile {
    Tile {
        texels: INNER + 2 * guard,
        filter_radius: f64::from(guard - 1),
    }
}

/// Where a camera's pixel shows the floor, if it does.
pub(crate) fn seen(camera: &CameraView, [width, height]: [u32; 2], pixel: usize) -> Option<DVec3> {
    let inverse = DMat4::from_cols_array_2d(&camera.clip_from_world).inverse();
    let [x, y] = [pixel as u32 % width, pixel as u32 / width].map(|at| 2.0 * (f64::from(at) + 0.5));
    let at = |depth| {
        inverse.project_point3(DVec3::new(
            x / f64::from(width) - 1.0,
            1.0 - y / f64::from(height),
            depth,
        ))
    };
    let [start, end] = [at(1.0), at(0.5)];
    let part = start.y / (start.y - end.y);
    (part > 0.0).then(|| start + part * (end - start))
}

/// How many texels a place lies within what a view shows; negative outside.
pub(crate) fn within(view: &LightView, point: DVec3) -> f64 {
    let clip = DMat4::from_cols_array_2d(&view.clip_from_world) * point.extend(1.0);
    let edge = 1.0 - (clip.truncate().truncate() / clip.w).abs().max_element();
    let texels = 0.5 * edge * f64::from(view.region.extent[0]) - f64::from(view.guard);
    if clip.w > 0.0 {
        texels
    } else {
        f64::NEG_INFINITY
    }
}

/// Places views of equal size in one map, and what a session shows of them.
fn in_one_map(gpu: &Gpu, frame: &Frame, camera: &CameraView, views: Vec<LightView>) -> Vec<f32> {
    in_one_map_by(HARD, gpu, frame, camera, views)
}

/// The same by a graph like that of hard shadows.
pub(crate) fn in_one_map_by(
    graph: &str,
    gpu: &Gpu,
    frame: &Frame,
    camera: &CameraView,
    mut views: Vec<LightView>,
) -> Vec<f32> {
    let texels = views[0].region.extent[0];
    let atlas = Atlas {
        size: [3 * texels, 2 * texels],
        layers: 1,
    };
    atlas.place(&mut views).unwrap();
    atlas.check(&views).unwrap();
    shaded_by(graph, gpu, frame, camera, atlas.size, &views)
}

/// Compares views in one atlas with each of them alone. Gives the largest difference with guard bands and without, and how many
/// pixels lie within a blur's radius of a border.
fn compare(gpu: &Gpu, frame: &Frame, views: &dyn Fn(u32) -> Vec<LightView>) -> [f64; 3] {
    let (camera, _) = places(frame);
    let wide = views(10 * (RADIUS + 1)).into_iter();
    let alone = wide.map(|mut view| {
        // Shown wherever it is a little more than the view itself.
        view.guard -= 1;
        shaded(gpu, frame, &camera, view.region.extent, &[view])
    });
    let alone: Vec<Vec<f32>> = alone.collect();
    let guarded = views(RADIUS + 1);
    assert_eq!(guarded[0].guard, RADIUS + 1);
    // Touching regions: what there is without guard bands.
    let touching = guarded.iter().map(|view| {
        let scale = f64::from(view.region.extent[0]) / f64::from(INNER);
        let scale = DMat4::from_scale(DVec3::new(scale, scale, 1.0));
        let clip = scale * DMat4::from_cols_array_2d(&view.clip_from_world);
        LightView {
            clip_from_world: clip.to_cols_array_2d(),
            region: MapRegion::new([0; 2], [INNER; 2]),
            guard: 0,
            ..*view
        }
    });
    let place = |views| in_one_map(gpu, frame, &camera, views);
    let pictures = [guarded.clone(), touching.collect()].map(place);
    let (mut largest, mut near) = ([0.0_f64; 2], 0);
    for pixel in 0..pictures[0].len() {
        let Some(point) = seen(&camera, frame.desc.picture, pixel) else {
            continue;
        };
        let inside: Vec<f64> = guarded.iter().map(|view| within(view, point)).collect();
        // The rounding of places decides right at a border.
        if inside.iter().any(|it| (it + 1.0 / 16.0).abs() < 0.07) {
            continue;
        }
        let first = inside.iter().position(|&it| it > 0.0);
        let expected = first.map_or(0.0, |view| f64::from(alone[view][pixel]));
        near += usize::from(inside.iter().any(|it| it.abs() < f64::from(RADIUS)));
        for (largest, picture) in largest.iter_mut().zip(&pictures) {
            *largest = largest.max((f64::from(picture[pixel]) - expected).abs());
        }
    }
    let [with, without] = largest;
    println!("{with:.6} with guard bands, {without:.3} without; {near} pixels near borders");
    [with, without, near as f64]
}

/// A camera over the floor.
pub(crate) fn frame(gpu: &Gpu, eye: DVec3, target: DVec3) -> Frame {
    let FrameDesc { camera, .. } = floor(gpu, wgpu::TextureFormat::Depth32Float, 1.0, false).desc;
    let mut mesh = Mesh::default();
    for [x, z] in [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
        mesh.positions.push([60.0 * x, 0.0, 60.0 * z]);
        mesh.normals.push([0.0, 1.0, 0.0]);
        mesh.uvs.push([0.0; 2]);
    }
    mesh.indices.extend([0, 1, 2, 0, 2, 3]);
    let scene = Scene {
        name: "floor".to_owned(),
        meshes: vec![mesh],
        materials: vec![Material::plain("grey", [0.5; 3])],
        ..Scene::default()
    };
    let light = Sun::spot(LAMP, DVec3::NEG_Y, 1.0, 1.0, None, [1.0, 9.0], false).unwrap();
    let desc = FrameDesc {
        picture: [240, 136],
        camera: Camera {
            eye,
            target,
            ..camera
        },
        light,
        ..floor(gpu, wgpu::TextureFormat::Depth32Float, 1.0, false).desc
    };
    Frame::draw(gpu, &scene, desc).unwrap()
}

#[test]
fn no_border_is_seen_between_the_faces_of_a_point_light() {
    let gpu = gpu();
    // Where the face below, one to the side and one ahead meet.
    let corner = DVec3::new(4.0, 0.0, 4.0);
    let frame = frame(&gpu, DVec3::new(1.0, 3.0, 0.0), corner);
    let range = DepthRange {
        near: 0.5,
        far: 16.0,
    };
    let [with, without, near] = compare(&gpu, &frame, &|guard| {
        let light = PointLight {
            position: LAMP.to_array(),
            depth: LightDepth::Linear { range },
            tile: tile(guard),
            nearest_caster: None,
        };
        light.faces().unwrap().to_vec()
    });
    assert!(with <= 1.0 / 255.0 && without > 0.1 && near > 500.0);
}

#[test]
fn no_border_is_seen_between_cascades() {
    let gpu = gpu();
    let frame = frame(&gpu, DVec3::new(1.0, 3.0, 0.0), DVec3::new(4.0, 0.0, 4.0));
    let (camera, _) = places(&frame);
    let [with, without, near] = compare(&gpu, &frame, &|guard| cascades(&camera, guard, 0.0));
    assert!(with <= 1.0 / 255.0 && without > 0.1 && near > 500.0);
}

/// Three cascades with a guard band, that blend over a part of their width.
pub(crate) fn cascades(camera: &CameraView, guard: u32, blend: f64) -> Vec<LightView> {
    let cascades = Cascades {
        direction: [0.4, -1.0, 0.3],
        splits: CascadeSplits::Given(vec![4.0, 7.0]),
        near: 1.0,
        far: 12.0,
        overlap: 0.1,
        blend,
        casters: Some([[-60.0, 0.0, -60.0], [60.0, 1.0, 60.0]]),
        pancaking: true,
        reversed: false,
        tile: tile(guard),
    };
    cascades.views(camera).unwrap()
}

#[test]
fn each_cascade_has_a_range_that_fits_itself() {
    let gpu = gpu();
    let frame = frame(&gpu, DVec3::new(1.0, 3.0, 0.0), DVec3::new(4.0, 0.0, 4.0));
    let (camera, _) = places(&frame);
    let mut views = cascades(&camera, RADIUS + 1, 0.0);
    let texels = views[0].region.extent[0];
    let atlas = Atlas {
        size: [3 * texels, texels],
        layers: 1,
    };
    atlas.place(&mut views).unwrap();
    let [plain, fitted] =
        [HARD, FITTED].map(|graph| shaded_by(graph, &gpu, &frame, &camera, atlas.size, &views));
    let apart: Vec<f32> = plain
        .iter()
        .zip(&fitted)
        .map(|(a, b)| (a - b).abs())
        .collect();
    let mean = apart.iter().sum::<f32>() / apart.len() as f32;
    let shadow = plain.iter().sum::<f32>() / plain.len() as f32;
    println!("{mean:.5} apart on average, of {shadow:.3} in shadow");
    // Single precision leaks little, so that the range changes little. With the range of another cascade it is 0.1.
    assert!(mean <= 5e-3 && shadow > 0.1, "{mean} {shadow}");
}

#[test]
fn cascades_blend_into_each_other_and_the_last_one_fades_out() {
    let gpu = gpu();
    let frame = frame(&gpu, DVec3::new(1.0, 3.0, 0.0), DVec3::new(4.0, 0.0, 4.0));
    let (camera, _) = places(&frame);
    let width = 0.125 * f64::from(INNER);
    let views = cascades(&camera, RADIUS + 1, 0.125);
    let sharp = cascades(&camera, RADIUS + 1, 0.0);
    let borders = [
        Border::Blend(width),
        Border::Blend(width),
        Border::Fade(width),
    ];
    assert_eq!([0, 1, 2].map(|it| views[it].border), borders);
    let blended = in_one_map(&gpu, &frame, &camera, views.clone());
    let alone = sharp
        .iter()
        .map(|view| shaded(&gpu, &frame, &camera, view.region.extent, &[*view]));
    let alone: Vec<Vec<f32>> = alone.collect();
    // How much changes at once at a border, with and without blending, and where the last one ends.
    let ([mut blending, mut switching], [mut fading, mut ending]) = ([0.0_f32; 2], [0.0_f32; 2]);
    let mut seen_pixels = [0; 4];
    for pixel in 0..blended.len() {
        let Some(point) = seen(&camera, frame.desc.picture, pixel) else {
            continue;
        };
        let found = blended[pixel];
        let inside: Vec<f64> = views.iter().map(|view| within(view, point)).collect();
        if inside.iter().any(|it| (it + 1.0 / 16.0).abs() < 0.07) {
            continue;
        }
        let mut containing = (0..3).filter(|&view| inside[view] > 0.0);
        let Some(first) = containing.next() else {
            assert_eq!(found, 0.0, "outside of all");
            continue;
        };
        let own = alone[first][pixel];
        let at_border = inside[first] < 0.5;
        match containing.next() {
            _ if inside[first] > width => {
                assert!((found - own).abs() <= 1.0 / 255.0, "{first}: {found} {own}");
                seen_pixels[0] += 1;
            }
            // The third of three, or the only one left.
            None if first == 2 => {
                assert!(found <= own + 1.0 / 255.0);
                if at_border {
                    fading = fading.max(found);
                    ending = ending.max(own);
                }
                seen_pixels[1] += 1;
            }
            None => {
                assert!((found - own).abs() <= 1.0 / 255.0, "{first}: {found} {own}");
                seen_pixels[2] += 1;
            }
            Some(next) if inside[next] > width => {
                let other = alone[next][pixel];
                let between = own.min(other) - 1.0 / 255.0..=own.max(other) + 1.0 / 255.0;
                assert!(between.contains(&found), "{found} of {own} and {other}");
                if at_border {
                    blending = blending.max((found - other).abs());
                    switching = switching.max((own - other).abs());
                }
                seen_pixels[3] += 1;
            }
            Some(_) => {}
        }
    }
    println!(
        "at borders {blending:.3} with blending, {switching:.3} without; at the end {fading:.3} and {ending:.3}; {seen_pixels:?}"
    );
    // Half a texel of sixteen is a part of 1/32.
    assert!(blending <= switching / 32.0 + 1.0 / 255.0 && switching > 0.2);
    assert!(fading <= ending / 32.0 + 1.0 / 255.0 && ending > 0.15);
    assert!(
        [0, 1, 3].iter().all(|&kind| seen_pixels[kind] > 100),
        "{seen_pixels:?}"
    );
}

#[test]
fn shadows_of_a_spot_end_with_its_cone() {
    let gpu = gpu();
    let frame = frame(&gpu, DVec3::new(1.0, 5.0, 0.0), DVec3::new(2.0, 0.0, 2.0));
    let (camera, _) = places(&frame);
    let range = DepthRange {
        near: 0.5,
        far: 16.0,
    };
    let light = PointLight {
        position: LAMP.to_array(),
        depth: LightDepth::Linear { range },
        tile: tile(RADIUS + 1),
        nearest_caster: None,
    };
    let square = light.spot([0.3, -1.0, 0.3], 1.2).unwrap();
    let width = 8.0;
    let cone = LightView {
        border: Border::Cone(width),
        ..square
    };
    let [square, cone] = [square, cone].map(|view| {
        (
            view,
            shaded(&gpu, &frame, &camera, view.region.extent, &[view]),
        )
    });
    let axis = DVec3::new(0.3, -1.0, 0.3).normalize();
    let mut seen_pixels = [0; 3];
    for pixel in 0..cone.1.len() {
        let Some(point) = seen(&camera, frame.desc.picture, pixel) else {
            continue;
        };
        // Texels from the circle inwards, from the angle to the axis.
        let to = point - LAMP;
        let along = to.dot(axis);
        let tangent = (to.length_squared() - along * along).sqrt() / along;
        let depth = 0.5 * f64::from(INNER) * (1.0 - tangent / 0.6_f64.tan());
        let (found, whole) = (cone.1[pixel], square.1[pixel]);
        let expected = f64::from(whole) * (depth / width).clamp(0.0, 1.0);
        assert!(
            (f64::from(found) - expected).abs() <= 0.02,
            "{found}, not {expected} at {depth}"
        );
        let kind = usize::from(depth > 0.0) + usize::from(depth > width);
        seen_pixels[kind] += usize::from(whole > 0.5);
    }
    println!("{seen_pixels:?}");
    assert!(
        seen_pixels.iter().all(|&count| count > 50),
        "{seen_pixels:?}"
    );
}
