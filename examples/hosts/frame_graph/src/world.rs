//! A small world: two balls on a plane, a sun and a lamp, as depth that arithmetic gives; and what the nodes are told of it.

use glam::dcamera::rh::proj::directx::{orthographic, perspective};
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec2, DVec3};
use moment_shadows::{
    CameraView, DepthRange, LeakReduction, LightSize, LightView, ReceiverBias,
    ScatteringParameters, SingleScattering, ViewParameters,
};
use moment_shadows_graph::Plan;

use crate::error::HostError;
use crate::graphs::Sizes;

const BALLS: [(DVec3, f64); 2] = [
    (DVec3::new(-0.9, 1.0, 0.0), 0.8),
    (DVec3::new(1.3, 0.7, 0.6), 0.5),
];

/// Where four samples lie in a texel.
const SAMPLES: [[f64; 2]; 4] = [
    [0.375, 0.125],
    [0.875, 0.375],
    [0.125, 0.625],
    [0.625, 0.875],
];

const NEAR: f64 = 1.0;
const FAR: f64 = 14.0;

/// Where the lights are. Moving one changes its depth map and what the nodes are told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct World {
    pub towards_sun: DVec3,
    pub lamp: DVec3,
}

impl Default for World {
    fn default() -> Self {
        Self {
            towards_sun: DVec3::new(0.5, 0.8, 0.4),
            lamp: DVec3::new(-3.0, 4.0, 3.0),
        }
    }
}

impl World {
    fn camera(sizes: Sizes) -> CameraView {
        let [width, height] = sizes.picture.map(f64::from);
        let eye = look_at_mat4(
            DVec3::new(0.5, 3.0, 7.0),
            DVec3::new(0.0, 0.4, 0.0),
            DVec3::Y,
        );
        // Near and far are exchanged: depth is reversed.
        let clip = perspective(0.45, width / height, 40.0, 0.5) * eye;
        CameraView {
            clip_from_world: clip.to_cols_array_2d(),
            far_depth: 0.0,
        }
    }

    /// Light 0 is the sun, light 1 the lamp. It is shaded by view `view` of its node: in the layer and the channel of that number.
    fn light(&self, index: u32, view: u32) -> LightView {
        let at = |from: DVec3| look_at_mat4(from, DVec3::new(0.0, 0.4, 0.0), DVec3::Y);
        let light = if index == 0 {
            let clip = orthographic(-4.0, 4.0, -4.0, 4.0, 0.0, 16.0);
            let clip = clip * at(self.towards_sun.normalize() * 8.0);
            LightView::orthographic(clip.to_cols_array_2d())
        } else {
            let clip = perspective(1.2, 1.0, NEAR, FAR) * at(self.lamp);
            let range = DepthRange {
                near: NEAR,
                far: FAR,
            };
            LightView::perspective(clip.to_cols_array_2d(), NEAR, FAR, range)
        };
        LightView {
            layer: view,
            channel: view,
            ..light
        }
    }

    /// The depth map of an import's layer: the samples of each texel, row by row.
    #[must_use]
    pub fn depth(&self, import: &str, layer: u32, samples: u32, sizes: Sizes) -> Vec<f32> {
        let is_camera = import == "camera_depth";
        let clip = if is_camera {
            Self::camera(sizes).clip_from_world
        } else {
            self.light(number(import, layer), 0).clip_from_world
        };
        let clip = DMat4::from_cols_array_2d(&clip);
        let (near, far) = if is_camera { (1.0, 0.0) } else { (0.0, 1.0) };
        let [width, height] = sizes.of(import);
        let inverse = clip.inverse();
        let mut depths = Vec::new();
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            for sample in 0..samples as usize {
                let at = if samples == 1 {
                    [0.5; 2]
                } else {
                    SAMPLES[sample % 4]
                };
                let at = DVec2::from(at) + DVec2::new(x.into(), y.into());
                let at = at / DVec2::new(width.into(), height.into()) * 2.0 - 1.0;
                let point = |depth| inverse.project_point3(DVec3::new(at.x, -at.y, depth));
                let (from, to) = (point(near), point(far));
                let hit = nearest(from, to - from).map(|hit| clip.project_point3(hit).z);
                depths.push(hit.unwrap_or(far) as f32);
            }
        }
        depths
    }

    /// A view's block.
    pub fn parameters(&self, plan: &Plan, sizes: Sizes) -> Result<Vec<u8>, HostError> {
        let blocks = &plan.parameters;
        let mut bytes = blocks.initial();
        let camera = Self::camera(sizes);
        let medium = SingleScattering::new([0.06; 3], [0.05; 3], 0.3, [6.0, 5.5, 5.0])?;
        for block in &blocks.blocks {
            let node = block.node.as_str();
            let views = 0..block.count.max(block.elements);
            let lights = views.map(|view| self.light(number(node, view), view));
            let lights: Vec<LightView> = lights.collect();
            let air = || ScatteringParameters::new(&camera, 30.0, &lights[0], medium);
            match block.name.as_str() {
                "DepthConversion" => {
                    for (layer, light) in (0..).zip(&lights) {
                        blocks.write(&mut bytes, node, layer, &light.depth.conversion()?)?;
                    }
                }
                "ViewParameters" => {
                    let views = lights
                        .iter()
                        .map(|light| shading(plan, node, &camera, light, sizes));
                    let views = views.collect::<Result<Vec<_>, _>>()?;
                    blocks.write_all(&mut bytes, node, 0, &views)?;
                }
                "RectifyMomentsParameters" => blocks.write(&mut bytes, node, 0, &air()?.rectify)?,
                "IntegrateScatteringParameters" => {
                    blocks.write(&mut bytes, node, 0, &air()?.integrate)?;
                }
                "CompositeScatteringParameters" => {
                    blocks.write(&mut bytes, node, 0, &air()?.composite)?;
                }
                // The graph says all that there is.
                _ => {}
            }
        }
        Ok(bytes)
    }
}

/// The light that a layer of an import, or a view of a node, is of.
fn number(of: &str, layer: u32) -> u32 {
    if of.contains("lamp") { 1 } else { layer }
}

fn shading(
    plan: &Plan,
    node: &str,
    camera: &CameraView,
    light: &LightView,
    sizes: Sizes,
) -> Result<ViewParameters, HostError> {
    let reads = plan
        .passes
        .iter()
        .filter(|pass| pass.node == node)
        .flat_map(|pass| &pass.reads);
    let maps = reads.filter_map(|it| plan.resources[it.resource].desc.texture());
    let deviation = maps.map(|map| f32::from(map.deviation)).fold(0.0, f32::max);
    let per_texel = light.depth_per_texel(sizes.map) as f32;
    let bias = ReceiverBias::for_kernel(deviation, per_texel);
    let mut view = ViewParameters::new(camera, light, bias, LeakReduction::DEFAULT)?;
    let sized = LightView {
        size: LightSize::AngularDiameter(0.1),
        ..*light
    };
    if light.channel == 0 && plan.passes.iter().any(|pass| pass.node == "sum") {
        view.light = sized.area_light(sizes.map, 1.0..=64.0)?;
    }
    Ok(view)
}

/// The first point along a segment that is on a ball or on the plane.
fn nearest(from: DVec3, along: DVec3) -> Option<DVec3> {
    let plane = Some(-from.y / along.y).filter(|at| at.is_finite());
    let balls = BALLS.iter().filter_map(|(centre, radius)| {
        let (to, squared) = (from - *centre, along.length_squared());
        let half = to.dot(along) / squared;
        let root = half * half - (to.length_squared() - radius * radius) / squared;
        (root >= 0.0).then(|| -half - root.sqrt())
    });
    let hits = balls.chain(plane).filter(|at| (0.0..=1.0).contains(at));
    hits.min_by(f64::total_cmp).map(|at| from + at * along)
}
