//! The views that the tiles of a picture try: all that contain one of its pixels, and none that all it shows lies beside.

use glam::{DMat4, DVec3, DVec4};
use moment_shadows::{
    CameraView, LeakReduction, LightView, Profile, ReceiverBias, TextureFormat, ViewParameters,
};
use moment_shadows_graph::Capabilities;
use moment_shadows_lab::gpu::Gpu;

use crate::many::{SIDE, spot};
use crate::normals::texture;
use crate::views::{frame, seen, within};
use crate::{HARD, gpu, parsed, places};

const TILE: usize = 16;
const VIEWS: usize = 128;

/// The bits of each tile that the node's pass writes for these views.
fn found(gpu: &Gpu, depth: &wgpu::Texture, views: &[ViewParameters]) -> Vec<[u32; 4]> {
    let shade = format!(r#""type": "shade_hard", "properties": {{ "views": {VIEWS} }}"#);
    let text = HARD.replace(r#""type": "shade_hard""#, &shade);
    let capabilities = Capabilities::of_profile(Profile::Native);
    let plan = parsed(&text).compile(&capabilities, &[]).unwrap();
    let pass = plan.passes.iter().find(|pass| pass.label == "find views");
    let wgsl = &plan.shaders[pass.unwrap().shader.unwrap()];
    let pipeline = gpu.compute("find views", wgsl, "find_views");
    let size = [depth.width(), depth.height()].map(|it| it.div_ceil(TILE as u32));
    let texture = |size: [u32; 2], format, usage| {
        gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("found views"),
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    };
    let usage = wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC;
    let target = texture(size, wgpu::TextureFormat::Rgba32Uint, usage);
    // Of the map its size alone counts.
    let usage = wgpu::TextureUsages::TEXTURE_BINDING;
    let map = texture([SIDE; 2], wgpu::TextureFormat::Rgba16Float, usage);
    let of_map = map.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    });
    let [depth, written] = [depth, &target].map(|it| it.create_view(&Default::default()));
    let bytes = bytemuck::cast_slice(views);
    let buffer = gpu.filled("views", bytes, wgpu::BufferUsages::UNIFORM);
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(capabilities.bind_group),
        entries: &[
            entry(0, buffer.as_entire_binding()),
            entry(1, wgpu::BindingResource::TextureView(&depth)),
            entry(2, wgpu::BindingResource::TextureView(&of_map)),
            entry(8, wgpu::BindingResource::TextureView(&written)),
        ],
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(capabilities.bind_group, &group, &[]);
    pass.dispatch_workgroups(size[0], size[1], 1);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    let bytes = gpu.read_texture(&target, 0, "found views").unwrap();
    bytemuck::pod_collect_to_vec(&bytes)
}

const EYE: DVec3 = DVec3::new(1.0, 3.0, 0.0);

/// Whether points lie beside a view, all beyond the same side of what it shows, by a part of how far they are from the camera.
fn beside(view: &LightView, points: &[DVec3]) -> bool {
    let clip = DMat4::from_cols_array_2d(&view.clip_from_world);
    // A texel less than the guard band: places are rounded.
    let guard = 2.0 * (f64::from(view.guard) - 1.0) / f64::from(view.region.extent[0]);
    let all = |side: &dyn Fn(DVec4) -> f64| {
        let mut points = points.iter();
        points.all(|point| side(clip * point.extend(1.0)) < -0.01 * (*point - EYE).length())
    };
    all(&|at| at.w)
        || [0, 1].into_iter().any(|axis| {
            all(&|at| (1.0 - guard) * at.w - at[axis]) || all(&|at| (1.0 - guard) * at.w + at[axis])
        })
}

#[test]
fn a_tile_tries_what_contains_a_pixel_and_nothing_that_it_lies_beside() {
    let gpu = gpu();
    let frame = frame(&gpu, EYE, DVec3::new(4.0, 0.0, 4.0));
    let (camera, _) = places(&frame);
    let views: Vec<LightView> = (0..VIEWS as u32)
        .map(|number| spot(number, 0, 0.0))
        .collect();
    let parameters = views.iter().map(|view| {
        let bias = ReceiverBias::NONE;
        ViewParameters::new(&camera, view, bias, LeakReduction::NONE).unwrap()
    });
    let parameters: Vec<_> = parameters.collect();
    let found = found(&gpu, &frame.surface.depth, &parameters);
    let [width, height] = frame.desc.picture.map(|it| it as usize);
    let columns = width.div_ceil(TILE);
    assert_eq!(found.len(), columns * height.div_ceil(TILE));
    let from_world = DMat4::from_cols_array_2d(&camera.clip_from_world);
    let (mut tried, mut left_out) = (0, 0);
    for (tile, bits) in found.iter().enumerate() {
        let [left, top] = [tile % columns * TILE, tile / columns * TILE];
        let [right, bottom] = [(left + TILE).min(width), (top + TILE).min(height)];
        let pixels = (top..bottom).flat_map(|y| (left..right).map(move |x| y * width + x));
        let seen = pixels.filter_map(|pixel| seen(&camera, frame.desc.picture, pixel));
        let points: Vec<DVec3> = seen.collect();
        let depths = points
            .iter()
            .map(|point| from_world.project_point3(*point).z);
        let (least, most) = depths.fold((1.0_f64, 0.0_f64), |(least, most), depth| {
            (least.min(depth), most.max(depth))
        });
        // What the tile may show, between its pixels' edges and these depths.
        let corners = [left, right].into_iter().flat_map(|x| {
            [top, bottom].into_iter().flat_map(move |y| {
                let x = 2.0 * x as f64 / width as f64 - 1.0;
                let y = 1.0 - 2.0 * y as f64 / height as f64;
                [least, most].map(|depth| DVec3::new(x, y, depth))
            })
        });
        let inverse = from_world.inverse();
        let corners: Vec<DVec3> = corners.map(|it| inverse.project_point3(it)).collect();
        for (number, view) in views.iter().enumerate() {
            let tries = bits[number / 32] >> (number % 32) & 1 == 1;
            // A place on the border may be rounded either way.
            if points.iter().any(|point| within(view, *point) > 0.01) {
                assert!(tries, "tile {tile} leaves view {number} out");
                tried += 1;
            } else if points.is_empty() || beside(view, &corners) {
                assert!(!tries, "tile {tile} tries view {number}");
                left_out += 1;
            }
        }
    }
    println!(
        "{tried} tried, {left_out} left out of {}",
        found.len() * VIEWS
    );
    assert!(tried > 500 && left_out > 5000, "{tried} {left_out}");
}

#[test]
fn a_tile_ends_where_its_outermost_pixels_do() {
    let gpu = gpu();
    // Three tiles each way, of one depth, and no light but from where the camera is: a view is a box of pixels.
    let side = 3 * TILE;
    let half = 0x8000_u16.to_le_bytes().repeat(side * side);
    let depth = texture(&gpu, TextureFormat::Depth16Unorm, [side as u32; 2], &half);
    let camera = CameraView {
        clip_from_world: DMat4::IDENTITY.to_cols_array_2d(),
        far_depth: 1.0,
    };
    let view = |[start, end]: [[f64; 2]; 2]| {
        let device = |at: [f64; 2]| {
            let [x, y] = at.map(|at| 2.0 * at / side as f64 - 1.0);
            DVec3::new(x, -y, 0.0)
        };
        let (start, end) = (device(start), device(end));
        let size = 0.5 * (end - start).abs();
        let clip = DMat4::from_scale(DVec3::new(1.0 / size.x, 1.0 / size.y, 1.0))
            * DMat4::from_translation(-0.5 * (start + end));
        let light = LightView::orthographic(clip.to_cols_array_2d());
        ViewParameters::new(&camera, &light, ReceiverBias::NONE, LeakReduction::NONE).unwrap()
    };
    // Boxes from far away to just beyond the middle of an outermost pixel of the tile in the middle, and to just before the tile.
    let [low, high] = [TILE as f64, 2.0 * TILE as f64];
    let far = 4.0 * side as f64;
    let along = [
        ([-far, low + 0.75], true),
        ([-far, low - 0.25], false),
        ([high - 0.75, far], true),
        ([high + 0.25, far], false),
    ];
    let boxes: Vec<([[f64; 2]; 2], bool)> = [0, 1]
        .into_iter()
        .flat_map(|axis| {
            along.map(|([start, end], holds)| {
                let mut corners = [[-far; 2], [far; 2]];
                corners[0][axis] = start;
                corners[1][axis] = end;
                (corners, holds)
            })
        })
        .collect();
    let views = boxes.iter().map(|(corners, _)| view(*corners));
    let views: Vec<ViewParameters> = views.cycle().take(VIEWS).collect();
    // The fifth of nine tiles.
    let bits = found(&gpu, &depth, &views)[4];
    for (number, (corners, holds)) in boxes.iter().enumerate() {
        let tries = bits[number / 32] >> (number % 32) & 1 == 1;
        assert_eq!(tries, *holds, "{corners:?}");
    }
}
