//! Rectified maps of light maps with mip levels.

use bytemuck::bytes_of;
use moment_shadows::{MapEncoding, RectifyMomentsParameters, Storage, Technique};
use moment_shadows_graph::TextureDesc;
use moment_shadows_lab::gpu::Gpu;
use wgpu::util::DeviceExt as _;

use crate::pictures::{MAP, Scene};
use crate::stage::{capabilities, gpu, run};

/// A map of float32 with mip levels, each the means of four texels of the one before.
fn minified(gpu: &Gpu, texels: &[[f32; 4]], levels: u32) -> (TextureDesc, wgpu::Texture) {
    let mut all = texels.to_vec();
    let mut finer = texels.to_vec();
    for level in 1..levels {
        let [from, to] = [MAP >> (level - 1), MAP >> level].map(|side| side as usize);
        finer = (0..to * to)
            .map(|index| {
                let first = 2 * (index / to) * from + 2 * (index % to);
                let four = [0, 1, from, from + 1].map(|offset| finer[first + offset]);
                [0, 1, 2, 3].map(|channel| four.iter().map(|it| it[channel]).sum::<f32>() / 4.0)
            })
            .collect();
        all.extend(&finer);
    }
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("map with mip levels"),
            size: wgpu::Extent3d {
                width: MAP,
                height: MAP,
                depth_or_array_layers: 1,
            },
            mip_level_count: levels,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        bytemuck::cast_slice(&all),
    );
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
    let desc = TextureDesc {
        mips: levels,
        ..TextureDesc::of_map(encoding, [MAP; 2])
    };
    (desc, texture)
}

/// The mean of |E[z]| over all texels of a rectified map, but for those next to the camera's own light ray, of a map with
/// surfaces at one end of the light's range or the other, without mip levels and with all of them.
fn contrasts(
    rectify: &RectifyMomentsParameters,
    [columns, rows]: [u32; 2],
    is_near: impl Fn(u32, u32) -> bool,
) -> [f32; 2] {
    let gpu = gpu();
    let graph = format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "map" }}],
  "nodes": [
    {{ "name": "rectify", "type": "rectify_moments",
       "properties": {{ "technique": "hamburger4", "storage": "float32", "extent": [{columns}, {rows}] }} }}
  ],
  "edges": [{{ "from": "map", "to": "rectify.map" }}],
  "outputs": [{{ "name": "rectified", "from": "rectify.rectified" }}]
}}"#
    );
    let texels: Vec<[f32; 4]> = (0..MAP * MAP)
        .map(|index| is_near(index % MAP, index / MAP))
        .map(|near| if near { -1.0 } else { 1.0 })
        .map(|z: f32| [z, 1.0, z, 1.0])
        .collect();
    [1, 9].map(|levels| {
        let layers = run(
            &gpu,
            &capabilities(&gpu),
            &graph,
            &[("map", &minified(&gpu, &texels, levels))],
            &[("rectify", bytes_of(rectify))],
            "rectified",
        );
        let texels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&layers[0]);
        let outer = |row: &'_ [[f32; 4]]| -> f32 {
            let first = columns as usize / 4;
            row[first..].iter().map(|texel| texel[0].abs()).sum()
        };
        let sum: f32 = texels.chunks(columns as usize).map(outer).sum();
        sum / (0.75 * (columns * rows) as f32)
    })
}

#[test]
fn texels_are_averaged_over_the_columns_that_they_cover() {
    let rectify = Scene::across().parameters().rectify;
    // Squares of a checkerboard are a texel wide, those of the rectified map seven.
    let checkers = |x: u32, y: u32| (x + y).is_multiple_of(2);
    let [plain, filtered] = contrasts(&rectify, [16, 16], checkers);
    println!("{plain}, filtered {filtered}");
    // Bilinear lookups in a checkerboard are off by a quarter on average.
    assert!(plain > 0.2 && filtered < 0.2 * plain, "{plain} {filtered}");
}

#[test]
fn texels_are_averaged_over_the_rows_that_they_cover() {
    let rectify = Scene::across().parameters().rectify;
    // Columns are as narrow as a texel, rows up to thirty texels apart.
    let checkers = |x: u32, y: u32| (x + y).is_multiple_of(2);
    let [plain, filtered] = contrasts(&rectify, [128, 4], checkers);
    println!("{plain}, filtered {filtered}");
    assert!(plain > 0.2 && filtered < 0.2 * plain, "{plain} {filtered}");
    // They run around the camera: rings about it stay.
    let centre = rectify.map_at_camera.map(|place| place * MAP as f32 - 0.5);
    let rings = |x: u32, y: u32| {
        let radius = (x as f32 - centre[0]).hypot(y as f32 - centre[1]);
        (radius / 10.0) as u32 % 2 == 1
    };
    let [plain, filtered] = contrasts(&rectify, [128, 4], rings);
    println!("{plain}, filtered {filtered}");
    assert!(plain > 0.8 && filtered > 0.7 * plain, "{plain} {filtered}");
}
