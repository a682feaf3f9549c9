//! Uniform data of a frame, put together in memory that is kept.

use moment_shadows::{
    CameraView, ContactShadowParameters, ContactShadows, DepthConversion, LeakReduction, LightView,
    MapRegion, MarchScatteringParameters, MarchedAir, ScatteringParameters, SingleScattering,
    TextureFormat, UpsampleScatteringParameters, ViewParameters,
};

use super::part::Part;
use super::unsuitable;
use super::{kernels, marched};
use crate::GraphError;

/// Lists that keep their memory from frame to frame.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    conversions: Vec<DepthConversion>,
    regions: Vec<MapRegion>,
    views: Vec<ViewParameters>,
    kernels: Vec<kernels::Words>,
    contacts: Vec<ContactShadowParameters>,
    marched: Vec<MarchScatteringParameters>,
    block: Vec<u8>,
}

/// What a host says of a frame.
pub(super) struct Told<'a> {
    pub(super) camera: &'a CameraView,
    pub(super) lights: &'a [LightView],
    pub(super) leak_reduction: LeakReduction,
    pub(super) medium: (SingleScattering, f64),
    pub(super) marched: MarchedAir,
    pub(super) contact: ContactShadows,
    pub(super) depth_format: Option<TextureFormat>,
    /// The import that is the light's depth map, if one is.
    pub(super) light_depth: Option<&'a str>,
}

impl Scratch {
    /// Writes what the nodes of a part are told, and the lights' regions where they are those of its maps: of all, or of the light's
    /// depth map alone. An error leaves the part's block as it was.
    pub(super) fn write(
        &mut self,
        part: &mut Part,
        told: &Told<'_>,
        of_all_maps: bool,
    ) -> Result<(), GraphError> {
        self.block.clone_from(&part.block);
        let (bytes, layout) = (&mut self.block, &part.plan.parameters);
        for shading in &part.shading {
            self.views.clear();
            for (index, light) in told.lights.iter().enumerate() {
                self.views.push(shading.parameters(told, light, index)?);
            }
            layout.write_all(bytes, &shading.node, 0, &self.views)?;
        }
        for block in &layout.blocks {
            let node = block.node.as_str();
            match block.name.as_str() {
                "DepthConversion" => {
                    for layer in 0..block.count {
                        self.conversions.clear();
                        for (index, light) in told.of_layer(layer) {
                            let conversion = light.depth.conversion();
                            self.conversions.push(conversion.map_err(|error| {
                                unsuitable(format!("view {index} of a light"), error)
                            })?);
                        }
                        if !self.conversions.is_empty() {
                            layout.write_all(bytes, node, layer, &self.conversions)?;
                        }
                    }
                }
                "RectifyMomentsParameters" => {
                    layout.write(bytes, node, 0, &told.scattering()?.rectify)?;
                }
                "IntegrateScatteringParameters" => {
                    layout.write(bytes, node, 0, &told.scattering()?.integrate)?;
                }
                "CompositeScatteringParameters" => {
                    layout.write(bytes, node, 0, &told.scattering()?.composite)?;
                }
                "MarchScatteringParameters" => {
                    marched::write(&mut self.marched, told, block)?;
                    layout.write_all(bytes, node, 0, &self.marched)?;
                }
                "UpsampleScatteringParameters" => {
                    let (_, far) = told.medium;
                    let parameters = UpsampleScatteringParameters::new(told.camera, far);
                    let parameters = parameters.map_err(|error| unsuitable("upsampling", error))?;
                    layout.write(bytes, node, 0, &parameters)?;
                }
                // Those above, and kernels, which are those of the graph file or follow.
                "ViewParameters" | "BlurParameters" | "ContactShadowParameters" => {}
                other => {
                    let reason = format!(
                        "its parameters ({other}) are known to the host alone; record this graph with the objects of 'record'"
                    );
                    return Err(unsuitable(format!("node '{node}'"), reason));
                }
            }
        }
        for seen in &part.seen {
            for layer in 0..seen.layers {
                seen.write(&mut self.views, told, told.of_layer(layer))?;
                if !self.views.is_empty() {
                    layout.write_all(bytes, &seen.node, layer, &self.views)?;
                }
            }
        }
        for contacts in &part.contacts {
            contacts.write(told, &mut self.contacts)?;
            layout.write_all(bytes, &contacts.node, 0, &self.contacts)?;
        }
        for blur in &part.blurs {
            for layer in 0..blur.layers() {
                blur.write(&mut self.kernels, told.of_layer(layer))?;
                if !self.kernels.is_empty() {
                    layout.write_all(bytes, &blur.node, layer, &self.kernels)?;
                }
            }
        }
        let has_regions = |map: &str| of_all_maps || told.light_depth == Some(map);
        for table in (layout.regions.iter()).filter(|table| has_regions(&table.map)) {
            for layer in 0..table.layers {
                let regions = told.of_layer(layer).map(|(_, light)| light.region);
                self.regions.clear();
                self.regions.extend(regions);
                if !self.regions.is_empty() {
                    layout.write_regions(bytes, &table.map, layer, &self.regions)?;
                }
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

    /// The views of a layer, with their numbers.
    fn of_layer(&self, layer: u32) -> impl Iterator<Item = (usize, &LightView)> {
        let lights = self.lights.iter().enumerate();
        lights.filter(move |(_, light)| light.layer == layer)
    }
}
