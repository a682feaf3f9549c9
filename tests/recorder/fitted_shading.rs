//! What maps shade like whose range fits itself: like those with a tight one, and steadily.

use moment_shadows::{ReceiverBias, TextureFormat};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;

use crate::depth_map;
use crate::setup::{Bound, aligned_view, bind, capabilities, compiled, gpu};

const MAP: [u32; 2] = [72, 40];

/// Stored depth of a moment depth.
fn stored(z: f32) -> f32 {
    0.5 + 0.5 * z
}

/// What a range is fitted to.
#[derive(Clone, Copy, PartialEq)]
enum Fit {
    Nothing,
    Casters,
    /// No farther than the camera sees.
    Seen,
}

/// Resolve, blur and shade, with ranges or without.
fn shading(storage: &str, fit: Fit) -> String {
    let node = match fit {
        Fit::Nothing => "",
        _ => r#"{ "name": "fit", "type": "fit_range" },"#,
    };
    let seen = match fit {
        Fit::Seen => r#"{ "from": "camera_depth", "to": "fit.camera_depth" },"#,
        _ => "",
    };
    let edges = match fit {
        Fit::Nothing => String::new(),
        _ => format!(
            r#"{seen}
               {{ "from": "light_depth", "to": "fit.depth" }},
               {{ "from": "fit.ranges", "to": "resolve.ranges" }},
               {{ "from": "fit.ranges", "to": "shade.ranges" }},"#
        ),
    };
    format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}, {{ "name": "camera_depth" }}],
  "nodes": [ {node}
    {{ "name": "resolve", "type": "resolve", "properties": {{ "storage": "{storage}" }} }},
    {{ "name": "blur", "type": "blur", "properties": {{ "kernel": {{ "radius": 2, "sigma": 1.2 }} }} }},
    {{ "name": "shade", "type": "shade_hard", "properties": {{ "format": "r32float" }} }}
  ],
  "edges": [ {edges}
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {{ "from": "resolve.map", "to": "blur.map" }},
    {{ "from": "blur.blurred", "to": "shade.map" }},
    {{ "from": "camera_depth", "to": "shade.camera_depth" }}
  ],
  "outputs": [{{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }}]
}}"#
    )
}

/// A graph that is bound to depth maps which can be drawn anew.
struct Shading {
    bound: Bound,
    light: wgpu::Texture,
    camera: wgpu::Texture,
}

impl Shading {
    /// With the bias of a kernel for a range that is so many times as long as the map is wide.
    fn new(gpu: &Gpu, storage: &str, times: f32, fit: Fit) -> Self {
        let desc = TextureDesc::new(TextureFormat::Depth32Float, MAP);
        let imports = [("light_depth", desc.clone()), ("camera_depth", desc)];
        let plan = compiled(&shading(storage, fit), &capabilities(gpu), &imports);
        let mut bytes = plan.parameters.initial();
        let mut view = aligned_view(0);
        view.receiver_bias = ReceiverBias::for_kernel(1.2, 2.0 / (MAP[0] as f32 * times));
        plan.parameters
            .write(&mut bytes, "shade", 0, &view)
            .unwrap();
        if fit == Fit::Seen {
            plan.parameters.write(&mut bytes, "fit", 0, &view).unwrap();
        }
        let format = wgpu::TextureFormat::Depth32Float;
        let [light, camera] = [0, 1].map(|_| depth_map::texture(gpu, format, MAP, 1, 1));
        let imports = [
            ("light_depth", ImportedResource::from(&light)),
            ("camera_depth", ImportedResource::from(&camera)),
        ];
        let bound = bind(gpu, plan, &imports, &bytes);
        Self {
            bound,
            light,
            camera,
        }
    }

    /// Shadow intensities for moment depths in the map and of the receivers.
    fn frame(
        &self,
        gpu: &Gpu,
        light: impl Fn(u32, u32) -> f32,
        camera: impl Fn(u32, u32) -> f32,
    ) -> Vec<f32> {
        let values = depth_map::values(MAP, |x, y| stored(light(x, y)));
        depth_map::draw(gpu, &self.light, 0, &values);
        let values = depth_map::values(MAP, |x, y| stored(camera(x, y)));
        depth_map::draw(gpu, &self.camera, 0, &values);
        self.bound.run(gpu);
        self.bound.read_floats(gpu, "shadow_intensity", 0)
    }
}

/// A plane that rises across the map, an occluder over its left half and a floor that is not in the map, all within 1/`times` of the
/// host's range: shadow intensities.
fn shaded(gpu: &Gpu, storage: &str, times: f32, fit: Fit) -> Vec<f32> {
    let at = |z: f32| 0.25 + (z - 0.25) / times;
    let plane = |x: u32| -0.25 + 0.5 * x as f32 / MAP[0] as f32;
    let light = |x, y| match (x < MAP[0] / 2, y < 30) {
        (true, _) => at(-0.75),
        (false, true) => at(plane(x)),
        // Nothing is drawn here.
        (false, false) => 1.0,
    };
    let camera = |x, y| if y < 30 { at(plane(x)) } else { at(0.9) };
    Shading::new(gpu, storage, times, fit).frame(gpu, light, camera)
}

/// How light leaks from behind a wide occluder that the camera sees, while the map goes on far behind everything that it sees: the range
/// ends there, and nothing gets darker.
#[test]
fn what_lies_behind_all_that_is_seen_makes_no_light_leak() {
    let gpu = gpu();
    let plane = |x: u32| -0.9 + 0.05 * x as f32 / MAP[0] as f32;
    // An occluder over the left half, a plane, and what is only in the map: below the plane, and where the picture shows nothing.
    let light = |x: u32, y: u32| match (x < MAP[0] / 2, y < 30, x.is_multiple_of(3)) {
        (_, false, _) => 0.9,
        (true, _, _) => -0.92,
        (false, _, true) => 0.3,
        (false, _, false) => plane(x),
    };
    let camera = |x, y: u32| if y < 30 { plane(x) } else { 1.0 };
    for storage in ["unorm16", "float16"] {
        let [casters, seen] = [Fit::Casters, Fit::Seen]
            .map(|fit| Shading::new(&gpu, storage, 1.0, fit).frame(&gpu, light, camera));
        let mean = |intensities: &[f32], shadowed: bool| {
            let of = (0..MAP[1] * MAP[0]).filter(|texel| {
                let (x, y) = (texel % MAP[0], texel / MAP[0]);
                let half = MAP[0] / 2;
                y < 26 && if shadowed { x < half - 4 } else { x > half + 4 }
            });
            let all: Vec<f32> = of.map(|texel| intensities[texel as usize]).collect();
            let sum: f32 = all.iter().sum();
            (
                sum / all.len() as f32,
                all.iter().copied().fold(0.0, f32::max),
            )
        };
        let leaks = [&casters, &seen].map(|it| 1.0 - mean(it, true).0);
        let darkest = mean(&seen, false).1;
        println!(
            "{storage}: leaks {:.4} fitted to casters, {:.4} to what is seen; shadow where there is none {darkest:.4}",
            leaks[0], leaks[1]
        );
        assert!(leaks[0] > 5e-3 && leaks[1] < 0.3 * leaks[0], "{leaks:?}");
        assert!(darkest <= 1e-3, "{darkest}");
    }
}

#[test]
fn a_fitted_map_shades_like_one_with_a_tight_range() {
    let gpu = gpu();
    for storage in ["unorm16", "float16"] {
        let leak = |intensities: &[f32]| {
            let shadowed = (0..MAP[1] * MAP[0]).filter(|texel| texel % MAP[0] < MAP[0] / 2 - 4);
            shadowed
                .map(|texel| 1.0 - intensities[texel as usize])
                .fold(0.0, f32::max)
        };
        // Near its edge the plane shadows the floor.
        let away = |texel: u32| (texel / MAP[0]).abs_diff(30) > 4;
        let lit = |intensities: &[f32]| {
            let lit = (0..MAP[1] * MAP[0])
                .filter(|texel| texel % MAP[0] > MAP[0] / 2 + 4 && away(*texel));
            lit.map(|texel| intensities[texel as usize])
                .fold(0.0, f32::max)
        };
        let tight = shaded(&gpu, storage, 1.0, Fit::Nothing);
        for times in [1.0, 10.0, 100.0] {
            let [plain, fitted] =
                [Fit::Nothing, Fit::Casters].map(|fit| shaded(&gpu, storage, times, fit));
            println!(
                "{storage}, {times} times: leaks {:.4} as it is and {:.4} fitted, {:.4} tight; shadow where there is none {:.4}",
                leak(&plain),
                leak(&fitted),
                leak(&tight),
                lit(&fitted)
            );
            assert!(
                leak(&fitted) <= 1.1 * leak(&tight) + 1e-3,
                "{storage}, {times}"
            );
            assert!(lit(&fitted) <= 1e-3, "{storage}, {times}");
            assert!(times < 100.0 || leak(&plain) > 0.1, "{storage}, {times}");
        }
    }
}

/// One caster moves away over 60 frames, and a shadow that leaks lies still. What the growing range makes of it.
#[test]
fn a_shadow_that_lies_still_hardly_changes_while_the_range_does() {
    let gpu = gpu();
    let shading = Shading::new(&gpu, "float16", 1.0, Fit::Casters);
    let frames: Vec<f32> = (0..60)
        .map(|frame| {
            let moving = 0.01 * frame as f32;
            let light = |x: u32, _| if x < 4 { 0.25 + moving } else { -0.5 };
            let intensities = shading.frame(&gpu, light, |_, _| -0.45);
            intensities[(20 * MAP[0] + 50) as usize]
        })
        .collect();
    let changes = frames.windows(2).filter(|pair| pair[0] != pair[1]).count();
    let largest = frames
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .fold(0.0, f32::max);
    println!(
        "intensity from {:.3} to {:.3}: {changes} changes in 60 frames, the largest {largest:.4}",
        frames[0], frames[59]
    );
    assert!((1..=20).contains(&changes), "{changes}");
    assert!(largest <= 0.02, "{largest}");
}

/// As a layer has it in which no range was found yet.
#[test]
fn a_texel_of_zeros_is_the_hosts_range() {
    const SHADER: &str = "
import moment_shadows::map::range_fit::{range_fit_map_depth, range_fit_of_texel};
alias BatchInput = vec4f;
alias BatchOutput = vec4f;
fn batch(depths: vec4f) -> vec4f {
    let fit = range_fit_of_texel(vec4f());
    return vec4f(range_fit_map_depth(fit, depths.x), range_fit_map_depth(fit, depths.y), range_fit_map_depth(fit, depths.z), fit.scale);
}
";
    let gpu = gpu();
    let batch = Batch::<[f32; 4], [f32; 4]>::new(&gpu, "zeros.wgsl", SHADER).unwrap();
    let found = batch.run(&[[-1.0, 0.3, 1.0, 0.0]]).unwrap();
    assert_eq!(found, [[-1.0, 0.3, 1.0, 1.0]]);
}
