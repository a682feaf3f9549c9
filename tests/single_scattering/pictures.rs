//! Pictures of scattered light against marched rays.

use bytemuck::bytes_of;
use glam::{DMat4, DVec3, DVec4};
use moment_shadows::{
    CameraView, LightView, MapEncoding, RectifiedView, ScatteringParameters, SingleScattering,
    Storage, Technique,
};
use moment_shadows_graph::TextureDesc;
use moment_shadows_lab::gpu::Gpu;

use crate::cameras::{Lens, Pair, looking, pair};
use crate::stage::{capabilities, gpu, run, sky, upload};

pub(crate) const PICTURE: [u32; 2] = [48, 32];
pub(crate) const MAP: u32 = 256;
pub(crate) const FAR: f64 = 20.0;

pub(crate) fn graph(technique: &str, storage: &str) -> String {
    graph_of([256, 256], technique, storage)
}

/// The graph of a technique and storage with a rectified map of some extent.
pub(crate) fn graph_of([columns, rows]: [u32; 2], technique: &str, storage: &str) -> String {
    format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "map" }}, {{ "name": "camera_depth" }}],
  "nodes": [
    {{ "name": "rectify", "type": "rectify_moments",
       "properties": {{ "technique": {technique}, "storage": "{storage}", "extent": [{columns}, {rows}] }} }},
    {{ "name": "integrate", "type": "integrate_scattering" }},
    {{ "name": "composite", "type": "composite_scattering", "properties": {{ "format": "rgba32float" }} }}
  ],
  "edges": [
    {{ "from": "map", "to": "rectify.map" }},
    {{ "from": "rectify.rectified", "to": "integrate.rectified" }},
    {{ "from": "integrate.integrated", "to": "composite.integrated" }},
    {{ "from": "camera_depth", "to": "composite.camera_depth" }}
  ],
  "outputs": [{{ "name": "scattering", "from": "composite.scattering" }}]
}}"#
    )
}

/// The same graph with the view rays of the camera's depth.
pub(crate) fn seen(graph: &str) -> String {
    graph.replace(
        r#""edges": ["#,
        r#""edges": [
    { "from": "camera_depth", "to": "rectify.camera_depth" },
    { "from": "rectify.view_rays", "to": "integrate.view_rays" },"#,
    )
}

/// A roof: square panes of 2 units and gaps of 2 between them at height 3, over all that the light's map sees.
fn covered(x: f64, z: f64) -> bool {
    let pane = |place: f64| (place / 2.0).floor().rem_euclid(2.0) < 1.0;
    pane(x) || pane(z)
}

const ROOF: f64 = 3.0;

/// A directional light and its map.
pub(crate) struct Sun {
    direction: DVec3,
    clip_from_world: DMat4,
}

impl Sun {
    pub(crate) fn new(direction: DVec3) -> Self {
        Self::ending(direction, 40.0)
    }

    /// Moment depth 1 is `end` units behind the origin, -1 always 40 units in front of it.
    pub(crate) fn ending(direction: DVec3, end: f64) -> Self {
        let direction = direction.normalize();
        let first = direction.any_orthonormal_vector();
        let second = direction.cross(first);
        let half = 30.0;
        let column = |axis: usize| {
            DVec4::new(
                first[axis] / half,
                second[axis] / half,
                direction[axis] / (40.0 + end),
                0.0,
            )
        };
        Self {
            direction,
            clip_from_world: DMat4::from_cols(
                column(0),
                column(1),
                column(2),
                DVec4::new(0.0, 0.0, 40.0 / (40.0 + end), 1.0),
            ),
        }
    }

    /// Whether light reaches a position.
    pub(crate) fn lights(&self, position: DVec3) -> bool {
        let back = (ROOF - position.y) / self.direction.y;
        let above = position + self.direction * back;
        back >= 0.0 || !covered(above.x, above.z)
    }

    pub(crate) fn view(&self) -> LightView {
        LightView::orthographic(self.clip_from_world.to_cols_array_2d())
    }

    pub(crate) fn direction(&self) -> DVec3 {
        self.direction
    }

    /// Raw moments of the map of the roof, each texel the mean of 16 samples.
    pub(crate) fn moments(&self) -> Vec<[f32; 4]> {
        self.moments_of(|near| {
            let along = (ROOF - near.y) / self.direction.y;
            let hit = near + self.direction * along;
            covered(hit.x, hit.z).then_some(along)
        })
    }

    /// Of anything that a light ray meets after a distance, from a place at the near end.
    pub(crate) fn moments_of(&self, meets: impl Fn(DVec3) -> Option<f64>) -> Vec<[f32; 4]> {
        let world_from_clip = self.clip_from_world.inverse();
        let sample = |u: f64, v: f64| {
            let clip = DVec4::new(2.0 * u - 1.0, 1.0 - 2.0 * v, 0.0, 1.0);
            let near = (world_from_clip * clip).truncate();
            meets(near).map_or(1.0, |along| {
                let hit = near + self.direction * along;
                2.0 * (self.clip_from_world * hit.extend(1.0)).z - 1.0
            })
        };
        (0..MAP * MAP)
            .map(|index| {
                let [x, y] = [index % MAP, index / MAP].map(f64::from);
                let mut sums = [0.0; 4];
                for part in 0..16 {
                    let [dx, dy] = [part % 4, part / 4].map(|step| (f64::from(step) + 0.5) / 4.0);
                    let z = sample((x + dx) / f64::from(MAP), (y + dy) / f64::from(MAP));
                    for (power, sum) in (1..).zip(&mut sums) {
                        *sum += z.powi(power) / 16.0;
                    }
                }
                sums.map(|sum| sum as f32)
            })
            .collect()
    }
}

pub(crate) const EYE: DVec3 = DVec3::new(0.4, 1.7, 0.3);

pub(crate) fn camera(forward: DVec3) -> Pair {
    let lens = Lens {
        field_of_view: 1.1,
        aspect: 1.5,
        near: 0.1,
        far: None,
    };
    pair(EYE, looking(forward, 0.2), lens, FAR, DVec3::NEG_Y)
}

pub(crate) fn camera_view(pair: &Pair) -> CameraView {
    CameraView {
        clip_from_world: pair.clip_from_world,
        far_depth: 0.0,
    }
}

pub(crate) fn medium(density: f32) -> SingleScattering {
    let extinction = [0.08, 0.1, 0.12].map(|value| value * density);
    let scattering = [0.07, 0.09, 0.1].map(|value| value * density);
    SingleScattering::new(extinction, scattering, 0.3, [3.0; 3]).unwrap()
}

/// A camera under the roof, its light and the light's map.
pub(crate) struct Scene {
    sun: Sun,
    camera: Pair,
    /// The texels of the light's map, row by row.
    pub(crate) moments: Vec<[f32; 4]>,
}

impl Scene {
    /// That looks across the light.
    pub(crate) fn across() -> Self {
        // The origin is not in the middle of its range.
        let sun = Sun::ending(DVec3::new(0.5, -1.0, 0.3), 30.0);
        Self {
            camera: camera(sun.direction.any_orthonormal_vector()),
            moments: sun.moments(),
            sun,
        }
    }

    pub(crate) fn parameters(&self) -> ScatteringParameters {
        self.parameters_of(&self.light())
    }

    pub(crate) fn camera(&self) -> Pair {
        self.camera
    }

    pub(crate) fn light_direction(&self) -> DVec3 {
        self.sun.direction
    }

    /// What describes the light.
    pub(crate) fn light(&self) -> LightView {
        self.sun.view()
    }

    /// With another description of the light.
    pub(crate) fn parameters_of(&self, light: &LightView) -> ScatteringParameters {
        self.parameters_in(light, medium(1.0))
    }

    /// And another medium.
    pub(crate) fn parameters_in(
        &self,
        light: &LightView,
        medium: SingleScattering,
    ) -> ScatteringParameters {
        let camera = camera_view(&self.camera);
        ScatteringParameters::new(&camera, FAR, light, medium).unwrap()
    }

    /// The light's map and the camera's depth.
    pub(crate) fn imports(&self, gpu: &Gpu) -> [(TextureDesc, wgpu::Texture); 2] {
        let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
        [
            upload(gpu, &encoding, [MAP; 2], &self.moments),
            sky(gpu, PICTURE),
        ]
    }
}

/// The picture that the nodes make.
pub(crate) fn picture(
    gpu: &Gpu,
    pair: &Pair,
    sun: &Sun,
    medium: SingleScattering,
    moments: &[[f32; 4]],
    graph: &str,
) -> Vec<[f32; 4]> {
    let parameters =
        ScatteringParameters::new(&camera_view(pair), FAR, &sun.view(), medium).unwrap();
    picture_of(gpu, &parameters, moments, graph)
}

/// The picture that the nodes make with any parameters.
pub(crate) fn picture_of(
    gpu: &Gpu,
    parameters: &ScatteringParameters,
    moments: &[[f32; 4]],
    graph: &str,
) -> Vec<[f32; 4]> {
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
    let map = upload(gpu, &encoding, [MAP; 2], moments);
    let camera_depth = sky(gpu, PICTURE);
    let layers = run(
        gpu,
        &capabilities(gpu),
        graph,
        &[("map", &map), ("camera_depth", &camera_depth)],
        &[
            ("rectify", bytes_of(&parameters.rectify)),
            ("integrate", bytes_of(&parameters.integrate)),
            ("composite", bytes_of(&parameters.composite)),
        ],
        "scattering",
    );
    bytemuck::pod_collect_to_vec(&layers[0])
}

/// Marched rays: radiance with shadows and without, by pixel.
pub(crate) fn truth(pair: &Pair, sun: &Sun, medium: &SingleScattering) -> Vec<[[f64; 3]; 2]> {
    const STEPS: usize = 1024;
    let view = RectifiedView::new(&pair.clip_from_world, FAR, sun.direction.to_array()).unwrap();
    let eye = DVec3::from_array(view.camera);
    let middle = pair.world_from_clip * DVec4::new(0.0, 0.0, 1.0, 1.0);
    let axis = (middle.truncate() / middle.w - eye).normalize();
    (0..PICTURE[0] * PICTURE[1])
        .map(|index| {
            let [x, y] =
                [index % PICTURE[0], index / PICTURE[0]].map(|place| f64::from(place) + 0.5);
            let clip = DVec4::new(
                2.0 * x / f64::from(PICTURE[0]) - 1.0,
                1.0 - 2.0 * y / f64::from(PICTURE[1]),
                1.0,
                1.0,
            );
            let point = pair.world_from_clip * clip;
            let ray = (point.truncate() / point.w - eye).normalize();
            let length = FAR / ray.dot(axis);
            let g = f64::from(medium.anisotropy);
            let cosine = -ray.dot(sun.direction);
            let phase = (1.0 - g * g)
                / (4.0 * core::f64::consts::PI * (1.0 + g * g - 2.0 * g * cosine).powf(1.5));
            let mut sums = [[0.0; 3]; 2];
            let step = length / STEPS as f64;
            for index in 0..STEPS {
                let distance = (index as f64 + 0.5) * step;
                let lit = sun.lights(eye + ray * distance);
                for colour in 0..3 {
                    let [extinction, scattering, irradiance] =
                        [medium.extinction, medium.scattering, medium.irradiance]
                            .map(|value| f64::from(value[colour]));
                    let part =
                        phase * scattering * irradiance * (-extinction * distance).exp() * step;
                    sums[0][colour] += if lit { part } else { 0.0 };
                    sums[1][colour] += part;
                }
            }
            sums
        })
        .collect()
}

/// Mean absolute error by colour, as a share of the mean radiance without shadows.
pub(crate) fn error(found: &[[f32; 4]], truth: &[[[f64; 3]; 2]]) -> [f64; 3] {
    [0, 1, 2].map(|colour| {
        let sum: f64 = found
            .iter()
            .zip(truth)
            .map(|(found, truth)| (f64::from(found[colour]) - truth[0][colour]).abs())
            .sum();
        let unshadowed: f64 = truth.iter().map(|truth| truth[1][colour]).sum();
        sum / unshadowed
    })
}

/// Across the light, towards it, away from it, and straight along it either way.
pub(crate) fn directions(sun: &Sun) -> [(&'static str, DVec3); 5] {
    let across = sun.direction.any_orthonormal_vector();
    [
        ("across", across),
        ("towards", across - 1.2 * sun.direction),
        ("away", across + 1.2 * sun.direction),
        ("straight towards", -sun.direction),
        ("straight away", sun.direction),
    ]
}

#[test]
fn shafts_of_light_are_those_of_marched_rays() {
    let gpu = gpu();
    let sun = Sun::ending(DVec3::new(0.5, -1.0, 0.3), 30.0);
    let moments = sun.moments();
    let medium = medium(1.0);
    // The last two know which view rays there are.
    let graphs = [
        graph("\"hamburger4\"", "float16"),
        graph("\"hamburger4\"", "float32"),
        graph("\"hamburger6\"", "float16"),
        graph("\"hamburger6\"", "float32"),
        seen(&graph("\"hamburger4\"", "float16")),
        seen(&graph("\"hamburger6\"", "float16")),
    ];
    let mut means = [0.0; 6];
    for (name, forward) in directions(&sun) {
        let pair = camera(forward);
        let truth = truth(&pair, &sun, &medium);
        for (number, (graph, mean)) in graphs.iter().zip(&mut means).enumerate() {
            let found = picture(&gpu, &pair, &sun, medium, &moments, graph);
            assert!(
                found.iter().flatten().all(|value| value.is_finite()),
                "{name}"
            );
            let errors = error(&found, &truth);
            println!(
                "{name}, {number}: {:.4} {:.4} {:.4}",
                errors[0], errors[1], errors[2]
            );
            *mean += errors.iter().sum::<f64>() / 15.0;
        }
    }
    println!("mean over all directions and colours: {means:?}");
    assert!(
        means[2] < means[0] && means[3] < means[1],
        "six moments are better than four: {means:?}"
    );
    assert!(
        means[4] < means[0] && means[5] < means[2],
        "view rays make both better: {means:?}"
    );
    assert!(means[0] <= 0.075 && means[2] <= 0.055, "{means:?}");
    assert!(means[4] <= 0.060 && means[5] <= 0.041, "{means:?}");
}
