//! `shade_hard` over regions, layers and mip levels: which views shade which pixels, and what their lookups read.

use moment_shadows::{
    AreaLight, Border, CameraView, DepthRange, LeakReduction, LightDepth, LightSize, LightView,
    MapRegion, ReceiverBias, TextureFormat, ViewParameters,
};
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_graph::{Capabilities, TextureDesc};
use moment_shadows_lab::gpu::Gpu;

use crate::depth_map;
use crate::setup::{Bound, IDENTITY, bind, capabilities, compiled, gpu};

pub(crate) const MAP: [u32; 2] = [128, 96];

/// Resolve, a kernel of one texel, mip levels, shading.
pub(crate) fn graph(storage: &str, mip_levels: u32, shade: &str) -> String {
    let (downsample, edges, from) = if mip_levels > 1 {
        (
            r#"{ "name": "downsample", "type": "downsample" },"#,
            r#"{ "from": "resolve.map", "to": "downsample.map" },"#,
            "downsample",
        )
    } else {
        ("", "", "resolve")
    };
    format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}, {{ "name": "camera_depth" }}],
  "nodes": [
    {{ "name": "resolve", "type": "resolve",
       "properties": {{ "storage": "{storage}", "mip_levels": {mip_levels} }} }},
    {downsample}
    {{ "name": "shade", "type": "shade_hard", "properties": {shade} }}
  ],
  "edges": [
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {edges}
    {{ "from": "{from}.map", "to": "shade.map" }},
    {{ "from": "camera_depth", "to": "shade.camera_depth" }}
  ],
  "outputs": [{{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }}]
}}"#
    )
}

/// A view whose clip space the light's matrix maps the scene to; the camera looks along it, over all of the picture.
pub(crate) fn view(
    light: [[f64; 4]; 4],
    layer: u32,
    region: MapRegion,
    channel: u32,
) -> ViewParameters {
    ViewParameters::new(
        &CameraView {
            clip_from_world: IDENTITY,
            far_depth: 1.0,
        },
        &LightView {
            clip_from_world: light,
            depth: LightDepth::Orthographic { reversed: false },
            layer,
            region,
            guard: 0,
            border: Border::Sharp,
            channel,
            size: LightSize::Point,
        },
        ReceiverBias::NONE,
        LeakReduction::NONE,
    )
    .unwrap()
}

/// A light that covers the part of the picture around (`x`, `y`) in clip space, of half a picture's width and height.
pub(crate) fn half_sized(x: f64, y: f64) -> [[f64; 4]; 4] {
    let mut light = IDENTITY;
    light[0][0] = 2.0;
    light[1][1] = 2.0;
    light[3] = [-2.0 * x, -2.0 * y, 0.0, 1.0];
    light
}

pub(crate) struct Shading {
    bound: Bound,
    picture: [u32; 2],
}

impl Shading {
    pub(crate) fn new(
        gpu: &Gpu,
        capabilities: &Capabilities,
        text: &str,
        light: (&wgpu::Texture, TextureDesc),
        camera: (&wgpu::Texture, [u32; 2]),
        views: &[ViewParameters],
        regions: &[MapRegion],
    ) -> Self {
        let desc = TextureDesc::new(TextureFormat::Depth32Float, camera.1);
        let plan = compiled(
            text,
            capabilities,
            &[("light_depth", light.1), ("camera_depth", desc)],
        );
        let mut bytes = plan.parameters.initial();
        plan.parameters
            .write_all(&mut bytes, "shade", 0, views)
            .unwrap();
        if !regions.is_empty() {
            plan.parameters
                .write_regions(&mut bytes, "light_depth", 0, regions)
                .unwrap();
        }
        let imports = [
            ("light_depth", ImportedResource::from(light.0)),
            ("camera_depth", ImportedResource::from(camera.0)),
        ];
        let bound = bind(gpu, plan, &imports, &bytes);
        Self {
            bound,
            picture: camera.1,
        }
    }

    /// The channels of every pixel.
    pub(crate) fn run(&self, gpu: &Gpu) -> Vec<[f32; 4]> {
        self.bound.run(gpu);
        let values = self.bound.read_floats(gpu, "shadow_intensity", 0);
        assert_eq!(values.len() as u32, 4 * self.picture[0] * self.picture[1]);
        values
            .chunks_exact(4)
            .map(|pixel| [pixel[0], pixel[1], pixel[2], pixel[3]])
            .collect()
    }
}

pub(crate) fn depth(regions: u32, layers: u32) -> TextureDesc {
    TextureDesc {
        regions,
        layers,
        ..TextureDesc::new(TextureFormat::Depth32Float, MAP)
    }
}

/// Sampled and loaded lookups, the former with the sampler's anisotropy whatever the adapter.
pub(crate) fn devices(gpu: &Gpu) -> [(Capabilities, &'static str); 4] {
    let native = Capabilities {
        anisotropic_sampling: true,
        ..capabilities(gpu)
    };
    let in_shader = Capabilities {
        anisotropic_sampling: false,
        ..native.clone()
    };
    let unfilterable = Capabilities {
        float32_filterable: false,
        ..native.clone()
    };
    [
        (native, "unorm16"),
        (in_shader, "unorm16"),
        (unfilterable.clone(), "float32"),
        (unfilterable, "float16"),
    ]
}

#[test]
fn a_view_reads_its_region_alone_however_far_pixels_reach() {
    let gpu = gpu();
    // Regions that touch on all sides and are aligned with no mip level; the middle one has no caster, the others are
    // full of them.
    let middle = MapRegion::new([37, 21], [51, 43]);
    let others = [
        MapRegion::new([0, 0], [37, 96]),
        MapRegion::new([88, 0], [40, 96]),
        MapRegion::new([37, 0], [51, 21]),
        MapRegion::new([37, 64], [51, 32]),
    ];
    let regions: Vec<MapRegion> = [middle].into_iter().chain(others).collect();
    let inside = |x: u32, y: u32| (37..88).contains(&x) && (21..64).contains(&y);
    for caster_in_the_middle in [false, true] {
        let map = depth_map::of(&gpu, MAP, |x, y| {
            if inside(x, y) == caster_in_the_middle {
                0.1
            } else {
                1.0
            }
        });
        for (capabilities, storage) in devices(&gpu) {
            // A texel per pixel, 3 x 4 pixels per texel, of which the last lie beyond the last texel's centre, and 6 x 11
            // texels per pixel.
            let magnified = [153, 172];
            for (levels, picture) in [
                (1, [51, 43]),
                (6, [51, 43]),
                (1, magnified),
                (6, magnified),
                (6, [9, 4]),
                (6, [40, 3]),
            ] {
                let camera = depth_map::of(&gpu, picture, |_, _| 0.8);
                let shading = Shading::new(
                    &gpu,
                    &capabilities,
                    &graph(storage, levels, r#"{ "format": "rgba32float" }"#),
                    (&map, depth(5, 1)),
                    (&camera, picture),
                    &[view(IDENTITY, 0, middle, 0)],
                    &regions,
                );
                for (pixel, [intensity, ..]) in shading.run(&gpu).into_iter().enumerate() {
                    let expected = if caster_in_the_middle { 1.0 } else { 0.0 };
                    // The moment bias is a light leak or a shadow of a few times alpha, which is 1e-3 in float16.
                    let tolerance = if storage == "float16" { 5e-3 } else { 5e-4 };
                    assert!(
                        (intensity - expected).abs() <= tolerance,
                        "{storage}, {levels} levels, {picture:?}, pixel {pixel}: {intensity} for {expected}"
                    );
                }
            }
        }
    }
}

/// A summed-area table between resolve and soft shading.
fn soft_graph(storage: &str, technique: &str) -> String {
    graph(storage, 1, r#"{ "format": "rgba32float" }"#)
        .replace(
            r#"{ "name": "shade", "type": "shade_hard""#,
            r#"{ "name": "sum", "type": "summed_area_table", "properties": { "largest_kernel": 129 } },
    { "name": "shade", "type": "shade_soft""#,
        )
        .replace(
            r#"{ "from": "resolve.map", "to": "shade.map" }"#,
            r#"{ "from": "resolve.map", "to": "sum.map" }, { "from": "sum.table", "to": "shade.table" }"#,
        )
        .replace(r#""mip_levels": 1"#, &format!(r#""technique": "{technique}""#))
}

#[test]
fn searches_and_filters_of_soft_shadows_end_at_their_region() {
    let gpu = gpu();
    let middle = MapRegion::new([37, 21], [51, 43]);
    let others = [
        MapRegion::new([0, 0], [37, 96]),
        MapRegion::new([88, 0], [40, 96]),
        MapRegion::new([37, 0], [51, 21]),
        MapRegion::new([37, 64], [51, 32]),
    ];
    let regions: Vec<MapRegion> = [middle].into_iter().chain(others).collect();
    let inside = |x: u32, y: u32| (37..88).contains(&x) && (21..64).contains(&y);
    let radii = 1.0..=64.0;
    let range = DepthRange {
        near: 0.0,
        far: 1.0,
    };
    // Penumbrae of up to 56 texels to either side: wider than the region.
    let light = AreaLight::new(LightSize::AngularDiameter(1.0), [0.01; 2], range, radii).unwrap();
    for caster_in_the_middle in [false, true] {
        let map = depth_map::of(&gpu, MAP, |x, y| {
            if inside(x, y) == caster_in_the_middle {
                0.1
            } else {
                1.0
            }
        });
        for (software_adapter, storage, technique) in [
            (false, "unorm16", "hamburger4"),
            (true, "unorm16", "hamburger4"),
            (true, "float32", "hamburger4"),
            (true, "float16", "hamburger4"),
            (false, "unorm16", "vsm"),
        ] {
            let capabilities = Capabilities {
                software_adapter,
                ..capabilities(&gpu)
            };
            let picture = [51, 43];
            let camera = depth_map::of(&gpu, picture, |_, _| 0.8);
            let mut view = view(IDENTITY, 0, middle, 0);
            view.light = light;
            let shading = Shading::new(
                &gpu,
                &capabilities,
                &soft_graph(storage, technique),
                (&map, depth(5, 1)),
                (&camera, picture),
                &[view],
                &regions,
            );
            for (pixel, [intensity, ..]) in shading.run(&gpu).into_iter().enumerate() {
                let expected = if caster_in_the_middle { 1.0 } else { 0.0 };
                // The moment bias, and the smallest variance of two moments, are a few times that much at this distance.
                let tolerance = if storage == "float16" { 5e-3 } else { 5e-4 };
                assert!(
                    (intensity - expected).abs() <= tolerance,
                    "{technique} {storage}, pixel {pixel}: {intensity} for {expected}"
                );
            }
        }
    }
}

#[test]
fn views_read_their_layers() {
    let gpu = gpu();
    let map = depth_map::texture(&gpu, wgpu::TextureFormat::Depth32Float, MAP, 3, 1);
    for layer in 0..3 {
        depth_map::clear(&gpu, &map, layer, if layer == 1 { 0.1 } else { 1.0 });
    }
    let picture = [8, 8];
    let camera = depth_map::of(&gpu, picture, |_, _| 0.8);
    let views: Vec<ViewParameters> = (0..3)
        .map(|layer| view(IDENTITY, layer, MapRegion::WHOLE, layer))
        .collect();
    let text = graph(
        "float32",
        4,
        r#"{ "format": "rgba32float", "lights": 3, "views": 3 }"#,
    );
    let capabilities = capabilities(&gpu);
    let light = (&map, depth(1, 3));
    let shading = Shading::new(
        &gpu,
        &capabilities,
        &text,
        light,
        (&camera, picture),
        &views,
        &[],
    );
    for [first, second, third, fourth] in shading.run(&gpu) {
        // The moment bias is a shadow of about alpha.
        assert!(
            first < 1e-5 && third < 1e-5 && fourth == 0.0,
            "{first}, {third}, {fourth}"
        );
        assert!(second > 0.999, "{second}");
    }
}

#[test]
fn a_minified_lookup_is_the_mean_over_the_pixel() {
    let gpu = gpu();
    // Stripes of 3 texels of casters and 5 without, both ways: a pixel of 16 x 12 texels sees 9 / 64 of them at most by
    // chance, and on average the share that it covers.
    let covered = |x: u32, y: u32| x % 8 < 3 || y % 6 < 1;
    let map = depth_map::of(&gpu, MAP, |x, y| if covered(x, y) { 0.1 } else { 1.0 });
    let picture = [8, 8];
    let camera = depth_map::of(&gpu, picture, |_, _| 0.8);
    for (capabilities, storage) in devices(&gpu) {
        for anisotropy in [1, 8] {
            let properties =
                format!(r#"{{ "format": "rgba32float", "anisotropy": {anisotropy} }}"#);
            let shading = Shading::new(
                &gpu,
                &capabilities,
                &graph(storage, 6, &properties),
                (&map, depth(1, 1)),
                (&camera, picture),
                &[view(IDENTITY, 0, MapRegion::WHOLE, 0)],
                &[],
            );
            // Every stripe pattern divides a pixel: each has this share of casters.
            let share = 1.0 - (5.0 / 8.0) * (5.0 / 6.0);
            for [intensity, ..] in shading.run(&gpu) {
                // The bound of two surfaces this far apart is their share, less the leak of the moment bias. Levels whose
                // texels are not a whole number of stripes add their own deviation.
                assert!(
                    (intensity - share).abs() < 0.06,
                    "{storage}, anisotropy {anisotropy}: {intensity} for {share}"
                );
            }
        }
    }
}
