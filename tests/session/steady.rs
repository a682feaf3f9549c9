//! How steady cascades are: what changes at a place from frame to frame while a camera moves and turns, and nothing else does.

use glam::dcamera::rh::proj::directx::perspective_infinite_reverse;
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec3};
use moment_shadows::{Atlas, CameraView, LightView, TextureFormat};

use crate::normals::texture;
use crate::views::{cascades, depths, frame, graph_of, seen, within};
use crate::{HARD, gpu, imports, places, recorded, session};

const FRAMES: u32 = 60;

/// The filter's guard band in texels.
const GUARD: u32 = 5;

/// The camera that cascades follow, at a walk.
fn walking(number: u32) -> CameraView {
    let t = f64::from(number);
    let eye = DVec3::new(1.0 + 0.06 * t, 3.0 + 0.2 * (0.2 * t).sin(), 0.03 * t);
    let turn = DVec3::new((0.6 + 0.015 * t).sin(), -0.55, (0.6 + 0.015 * t).cos());
    let clip = perspective_infinite_reverse(1.0, 1.6, 0.1)
        * look_at_mat4(eye, eye + turn.normalize(), DVec3::Y);
    CameraView {
        clip_from_world: clip.to_cols_array_2d(),
        far_depth: 0.0,
    }
}

/// Whether a camera sees a place before the last cascade ends.
fn sees(camera: &CameraView, point: DVec3) -> bool {
    let clip = DMat4::from_cols_array_2d(&camera.clip_from_world) * point.extend(1.0);
    clip.w > 1.0 && clip.w < 12.0 && clip.x.abs().max(clip.y.abs()) < clip.w
}

/// The first cascade that contains a place, and whether the place is away from the border of every one that is as fine: by more
/// than `width` texels, and half a texel for rounding.
fn shading(views: &[LightView], point: DVec3, width: f64) -> (Option<usize>, bool) {
    let inside: Vec<f64> = views.iter().map(|view| within(view, point)).collect();
    let first = inside.iter().position(|&it| it > 0.0);
    let near = inside.iter().take(first.map_or(inside.len(), |it| it + 1));
    let away = near.copied().all(|it: f64| it < -0.5 || it > width + 0.5);
    (first, away)
}

/// The stored depth of a place.
fn along(view: &LightView, point: DVec3) -> f64 {
    (DMat4::from_cols_array_2d(&view.clip_from_world) * point.extend(1.0)).z
}

/// The largest and the mean change of intensity from frame to frame: of all places that the camera sees, and of those that a cascade
/// shades alone in both frames, while its own range stays or moves by a sixteenth.
#[derive(Debug, Default)]
struct Changes {
    largest: f32,
    mean: f64,
    /// Of frames in which the range stays, and in which it moves.
    within: [f32; 2],
    places: [u64; 2],
}

/// Shades the floor, seen from above by a second camera that stands still, by cascades that follow the first one.
fn changes(blend: f64) -> Changes {
    let gpu = gpu();
    let above = frame(&gpu, DVec3::new(5.0, 16.0, 3.0), DVec3::new(5.0, 0.0, 4.0));
    let (still, _) = places(&above);
    let placed = |number: u32| {
        let mut views = cascades(&walking(number), GUARD, blend);
        let texels = views[0].region.extent[0];
        let atlas = Atlas {
            size: [3 * texels, texels],
            layers: 1,
        };
        atlas.place(&mut views).unwrap();
        (views, atlas.size)
    };
    let (views, size) = placed(0);
    let map = texture(
        &gpu,
        TextureFormat::R32Float,
        size,
        bytemuck::cast_slice(&depths(size, &views)),
    );
    let mut imports = imports(&above);
    imports[0].1 = (&map).into();
    let mut session = session(&gpu, &graph_of(HARD, &views), &imports);
    let points: Vec<Option<DVec3>> = {
        let [width, height] = above.desc.picture;
        let pixels = 0..(width * height) as usize;
        pixels
            .map(|pixel| seen(&still, above.desc.picture, pixel))
            .collect()
    };
    let width = blend * f64::from(views[0].region.extent[0] - 2 * GUARD);
    let mut found = Changes::default();
    let (mut sum, mut count) = (0.0, 0_u64);
    let mut before: Option<(Vec<f32>, Vec<LightView>)> = None;
    for number in 0..FRAMES {
        let (views, size) = placed(number);
        let depths = depths(size, &views);
        gpu.queue.write_texture(
            map.as_image_copy(),
            bytemuck::cast_slice(&depths),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * size[0]),
                rows_per_image: None,
            },
            map.size(),
        );
        session.view(&gpu.queue, 0, &still, &views).unwrap();
        let bytes = recorded(&gpu, &session, 0, "shadow_intensity");
        let picture: Vec<f32> = bytemuck::pod_collect_to_vec(&bytes);
        if let Some((last, last_views)) = &before {
            for (pixel, point) in points.iter().enumerate() {
                let Some(point) = point else { continue };
                if !(sees(&walking(number), *point) && sees(&walking(number - 1), *point)) {
                    continue;
                }
                let change = (picture[pixel] - last[pixel]).abs();
                sum += f64::from(change);
                count += 1;
                found.largest = found.largest.max(change);
                let [now, then] = [&views, last_views].map(|it| shading(it, *point, width));
                if let ((Some(view), true), true) = (now, now == then) {
                    let [before, after] = [last_views, &views].map(|it| along(&it[view], *point));
                    let moves = usize::from((before - after).abs() > 1e-9);
                    found.within[moves] = found.within[moves].max(change);
                    found.places[moves] += 1;
                }
            }
        }
        before = Some((picture, views));
    }
    found.mean = sum / count as f64;
    println!(
        "blending over {blend}: the largest change of intensity {:.4}, on average {:.6}, of {count} places; where one cascade shades alone \
         {:.6} while its range stays, {:.6} where that moves, of {:?} places",
        found.largest, found.mean, found.within[0], found.within[1], found.places
    );
    found
}

#[test]
fn a_camera_that_moves_and_turns_changes_no_shadow_but_at_borders() {
    let [sharp, blended] = [0.0, 0.125].map(changes);
    for found in [&sharp, &blended] {
        // Texels stay where they are, and all that is left is rounding.
        assert!(found.within[0] <= 1e-3, "{found:?}");
        // The bias of moments pulls towards the middle of a range, which is another.
        assert!(found.within[1] <= 1e-2, "{found:?}");
        assert!(found.places.iter().all(|&it| it > 10_000), "{found:?}");
    }
    // At a border filters become as wide as other texels are, at once or over sixteen texels.
    assert!(sharp.largest > 0.2 && blended.largest < 0.2 * sharp.largest);
}
