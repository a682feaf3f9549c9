//! Uniform data of a frame, put together in memory that is kept.

use moment_shadows::{
    CameraView, DepthConversion, LeakReduction, LightView, MapRegion, ScatteringParameters,
    SingleScattering, TextureFormat, ViewParameters,
};

use super::part::Part;
use super::unsuitable;
use crate::GraphError;

/// Lists that keep their memory from frame to frame.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    conversions: Vec<DepthConversion>,
    regions: Vec<MapRegion>,
    views: Vec<ViewParameters>,
    block: Vec<u8>,
}

/// What a host says of a frame.
pub(super) struct Told<'a> {
    pub(super) camera: &'a CameraView,
    pub(super) lights: &'a [LightView],
    pub(super) leak_reduction: LeakReduction,
    pub(super) medium: (SingleScattering, f64),
    pub(super) depth_format: Option<TextureFormat>,
}

impl Scratch {
    /// Writes what the nodes that make light maps are told. An error leaves the part's block as it was.
    pub(super) fn maps(&mut self, part: &mut Part, lights: &[LightView]) -> Result<(), GraphError> {
        self.block.clone_from(&part.block);
        let layout = &part.plan.parameters;
        for block in &layout.blocks {
            if block.name != "DepthConversion" {
                continue;
            }
            for layer in 0..block.count {
                self.conversions.clear();
                for (index, light) in of_layer(lights, layer) {
                    self.conversions.push(
                        light.depth.conversion().map_err(|error| {
                            unsuitable(format!("view {index} of a light"), error)
                        })?,
                    );
                }
                if !self.conversions.is_empty() {
                    layout.write_all(&mut self.block, &block.node, layer, &self.conversions)?;
                }
            }
        }
        for table in &layout.regions {
            for layer in 0..table.layers {
                self.regions.clear();
                self.regions
                    .extend(of_layer(lights, layer).map(|(_, light)| light.region));
                if !self.regions.is_empty() {
                    layout.write_regions(&mut self.block, &table.map, layer, &self.regions)?;
                }
            }
        }
        core::mem::swap(&mut self.block, &mut part.block);
        Ok(())
    }

    /// Writes what the nodes of a camera are told. An error leaves the part's block as it was.
    pub(super) fn picture(&mut self, part: &mut Part, told: &Told<'_>) -> Result<(), GraphError> {
        self.block.clone_from(&part.block);
        let layout = &part.plan.parameters;
        for shading in &part.shading {
            self.views.clear();
            for (index, light) in told.lights.iter().enumerate() {
                let view = shading.parameters(told, light, index)?;
                self.views.push(view);
            }
            layout.write_all(&mut self.block, &shading.node, 0, &self.views)?;
        }
        let mut scattering = None;
        for block in &layout.blocks {
            let parameters = match block.name.as_str() {
                "RectifyMomentsParameters"
                | "IntegrateScatteringParameters"
                | "CompositeScatteringParameters" => match scattering {
                    Some(parameters) => parameters,
                    None => *scattering.insert(told.scattering()?),
                },
                _ => continue,
            };
            let (bytes, node) = (&mut self.block, block.node.as_str());
            match block.name.as_str() {
                "RectifyMomentsParameters" => layout.write(bytes, node, 0, &parameters.rectify)?,
                "IntegrateScatteringParameters" => {
                    layout.write(bytes, node, 0, &parameters.integrate)?;
                }
                _ => layout.write(bytes, node, 0, &parameters.composite)?,
            }
        }
        core::mem::swap(&mut self.block, &mut part.block);
        Ok(())
    }
}

impl Told<'_> {
    /// What single scattering is told: of the first light.
    fn scattering(&self) -> Result<ScatteringParameters, GraphError> {
        let light = self
            .lights
            .first()
            .ok_or_else(|| unsuitable("single scattering", "there is no light; give one"))?;
        let (medium, far) = self.medium;
        ScatteringParameters::new(self.camera, far, light, medium)
            .map_err(|error| unsuitable("single scattering", error))
    }
}

/// The views of a layer, with their numbers.
fn of_layer(lights: &[LightView], layer: u32) -> impl Iterator<Item = (usize, &LightView)> {
    let lights = lights.iter().enumerate();
    lights.filter(move |(_, light)| light.layer == layer)
}
