//! The translucent casters of a scene, in the map of a sun: what they let through to what is opaque behind them.

use core::fmt;

use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;
use serde::Serialize;

use super::report::{errors, maps, opacity_of};
use super::stage::{Surfaces, TranslucentStage};
use super::triangles::Triangles;
use crate::error::LabError;
use crate::light::LightView;
use crate::scene::Scene;
use crate::texture::upload;
use crate::truth::peel::{LightSurface, Peeler};
use crate::view::View;

/// A map with a scene's casters, over all of its texels whose ray meets a translucent surface and then an opaque one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneRow {
    /// Technique and storage.
    pub map: String,
    /// The moment bias for as many casters as lie over each other.
    pub bias: f64,
    /// The mean transmittance that the map gives at what is opaque.
    pub transmittance: f64,
    /// How far the bound is above 1 - transmittance, at most.
    pub above: f64,
    /// How far it is below, on average.
    pub below: f64,
}

/// What the translucent casters of a scene let through.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneTransmittance {
    /// The scene.
    pub scene: String,
    /// Rays that are judged: each meets a translucent surface and then an opaque one.
    pub rays: usize,
    /// The most translucent surfaces that a ray meets.
    pub casters: u32,
    /// The mean of the exact transmittance: of the products of 1 - alpha of all surfaces that a ray crosses.
    pub truth: f64,
    /// What maps give.
    pub rows: Vec<SceneRow>,
}

/// A ray of the light.
#[derive(Clone, Copy)]
struct Ray {
    /// Depth of the first opaque surface, as a map stores it; none where there is none.
    opaque: Option<f32>,
    transmittance: f64,
    /// Translucent surfaces in front of it.
    crossed: u32,
}

impl SceneTransmittance {
    /// Blends a scene's casters into every map, of as many texels as the stage has, for the sun of one of the numbered views.
    pub fn of(stage: &TranslucentStage, scene: &Scene, view: u32) -> Result<Self, LabError> {
        let side = stage.side();
        let light = View::numbered(scene, view).sun(scene, [side; 2], 2.0, false)?;
        let surfaces = Peeler::new(scene, &light, [side; 2])?.rows(0..side);
        // What is opaque behind all casters has a depth of its own, too.
        let farthest = surfaces.iter().map(|it| it.distance).fold(0.0, f64::max);
        let [near, far] = light.range;
        let light = light.reaching(farthest.max(far) + 0.01 * (farthest - near));
        let rays = rays(&light, side, &surfaces);
        let judged: Vec<usize> = (0..rays.len())
            .filter(|&ray| rays[ray].crossed > 0 && rays[ray].opaque.is_some())
            .collect();
        if judged.is_empty() {
            return Err(LabError::unsuitable(
                &scene.name,
                "no ray of the light meets a translucent surface and then an opaque one; materials are translucent whose 'alphaMode' is BLEND",
            ));
        }
        let casters = judged.iter().map(|&ray| rays[ray].crossed).max();
        let casters = casters.unwrap_or_default();
        let of_judged = |all: &mut dyn FnMut(usize) -> f64| -> Vec<f64> {
            judged.iter().map(|&ray| all(ray)).collect()
        };
        let truth = of_judged(&mut |ray| 1.0 - rays[ray].transmittance);
        let stored = |[x, y]: [u32; 2]| rays[(y * side + x) as usize].opaque.unwrap_or(1.0);
        let surfaces = Surfaces {
            opaque: &stored,
            receiver: &stored,
            blurred: false,
        };
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let depths: Vec<f32> = rays.iter().map(|ray| ray.opaque.unwrap_or(1.0)).collect();
        let opaque = TextureDesc::new(TextureFormat::R32Float, [side; 2]);
        let opaque = upload(stage.gpu(), &opaque, bytemuck::cast_slice(&depths));
        let mut rows = Vec::new();
        for (map, bias) in maps(stage, casters, true)? {
            let encoding = (&map, opacity_of(stage, &map, true));
            let drawn = Triangles::new(stage.gpu(), encoding, (scene, &light), &opaque)?;
            let found = stage.shaded(&map, &surfaces, &mut |pass, encoder| {
                drawn.draw(pass.targets, encoder);
            })?;
            let found: Vec<f32> = judged.iter().map(|&ray| found[ray]).collect();
            let (above, below) = errors(&found, &truth);
            let lights: Vec<f64> = found.iter().map(|&it| 1.0 - f64::from(it)).collect();
            rows.push(SceneRow {
                map: map.to_string(),
                bias: bias.unwrap_or(f64::NAN),
                transmittance: mean(&lights),
                above,
                below,
            });
        }
        Ok(Self {
            scene: scene.name.clone(),
            rays: judged.len(),
            casters,
            truth: 1.0 - mean(&truth),
            rows,
        })
    }
}

/// The rays through all texels, row by row.
fn rays(light: &LightView, side: u32, surfaces: &[LightSurface]) -> Vec<Ray> {
    let none = Ray {
        opaque: None,
        transmittance: 1.0,
        crossed: 0,
    };
    let mut rays = vec![none; (side * side) as usize];
    for surface in surfaces {
        let [x, y] = surface.texel;
        let ray = &mut rays[(y * side + x) as usize];
        if ray.opaque.is_some() {
            continue;
        }
        if surface.opacity < 1.0 || surface.blended > 0 {
            ray.transmittance *= 1.0 - surface.opacity;
            ray.crossed += surface.blended;
        } else {
            let depth = light.moment_depth_of_distance(surface.distance);
            ray.opaque = Some((0.5 * depth + 0.5) as f32);
        }
    }
    rays
}

impl fmt::Display for SceneTransmittance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            scene,
            rays,
            casters,
            truth,
            ..
        } = self;
        writeln!(
            f,
            "{scene}: {rays} rays through at most {casters} translucent surfaces, which let {truth:.4} of the light through\n"
        )?;
        writeln!(
            f,
            "| map | bias | transmittance | above, at most | below, on average |"
        )?;
        writeln!(f, "|---|---|---|---|---|")?;
        for row in &self.rows {
            let bias = match row.bias {
                bias if bias.is_nan() => "-".to_owned(),
                bias => format!("{bias:.1e}"),
            };
            let (map, light, above, below) = (&row.map, row.transmittance, row.above, row.below);
            writeln!(
                f,
                "| {map} | {bias} | {light:.4} | {above:.1e} | {below:.4} |"
            )?;
        }
        Ok(())
    }
}
