//! The nodes of a part that shade, and what they are told of cameras and lights.

use core::ops::RangeInclusive;

use moment_shadows::{
    Border, Kernel, LightView, MapRegion, ReceiverBias, TextureFormat, ViewParameters,
};

use super::cut::{owner, slot};
use super::scratch::Told;
use super::seen::Seen;
use super::unsuitable;
use crate::nodes::BORDERS;
use crate::{Graph, GraphError, Plan, TextureDesc};

/// Half widths in texels where the map is no summed-area table, which limits them. The smallest makes shadows hard where they
/// touch what casts them.
const RADII: RangeInclusive<f64> = 1.0..=64.5;

/// A node that shades.
#[derive(Debug)]
pub(super) struct Shading {
    pub(super) node: String,
    /// The map that it looks up.
    map: TextureDesc,
    /// Channels of its outputs, one per light.
    channels: u32,
    /// Whether views have borders.
    borders: bool,
    radii: RangeInclusive<f64>,
}

impl Shading {
    /// The nodes of a plan that shade.
    pub(super) fn all(graph: &Graph, plan: &Plan) -> Result<Vec<Self>, GraphError> {
        let blocks = plan.parameters.blocks.iter();
        let seen = Seen::all(plan);
        let blocks = blocks.filter(|block| {
            block.name == "ViewParameters" && seen.iter().all(|seen| seen.node != block.node)
        });
        let all = blocks.map(|block| Self::of(graph, plan, &block.node));
        all.collect()
    }

    fn of(graph: &Graph, plan: &Plan, node: &str) -> Result<Self, GraphError> {
        let unsuitable = |reason| unsuitable(format!("node '{node}'"), reason);
        let mut edges = graph.edges.iter();
        let edge = edges.find(|edge| {
            owner(&edge.to) == node && ["map", "table", "depth"].contains(&slot(&edge.to))
        });
        let mut resources = plan.resources.iter();
        let resource = edge.and_then(|edge| resources.find(|resource| resource.name == edge.from));
        let map = resource.and_then(|resource| resource.desc.texture());
        let map = map.ok_or_else(|| {
            unsuitable("its map is made anew for each camera; record this graph with the objects of 'record'")
        })?;
        let targets = plan.resources.iter().filter_map(|resource| {
            let slot = resource.name.strip_prefix(node)?.strip_prefix('.')?;
            let is_target = slot.starts_with("shadow_intensity");
            is_target.then(|| resource.desc.texture()).flatten()
        });
        let channels = targets.map(|target| target.format.channels()).sum();
        let table = map.encoding.as_ref().and_then(|encoding| encoding.table());
        let largest = table.map_or(*RADII.end(), |table| {
            let [width, height] = table.largest_kernel();
            0.5 * f64::from(width.min(height))
        });
        Ok(Self {
            node: node.to_owned(),
            map: map.clone(),
            channels,
            borders: (plan.passes.iter())
                .any(|pass| pass.node == node && pass.constants.contains_key(BORDERS)),
            radii: RADII.start().min(largest)..=largest,
        })
    }

    /// What the node is told of one view of a light, which is number `index` of those that the host gives.
    pub(super) fn parameters(
        &self,
        told: &Told<'_>,
        light: &LightView,
        index: usize,
    ) -> Result<ViewParameters, GraphError> {
        let what = format_args!("view {index} of a light, for node '{}'", self.node);
        let unsuitable = |reason: String| unsuitable(what, reason);
        if light.layer >= self.map.layers {
            return Err(unsuitable(format!(
                "its layer is {}, but the map has {}, counted from 0",
                light.layer, self.map.layers
            )));
        }
        if light.channel >= self.channels {
            return Err(unsuitable(format!(
                "its channel is {}, but the node's outputs have {}, counted from 0; give the node as many 'lights'",
                light.channel, self.channels
            )));
        }
        if light.border != Border::Sharp && !self.borders {
            return Err(unsuitable(
                "it has a border that is not sharp; give the node the property 'borders'"
                    .to_owned(),
            ));
        }
        let extent = extent(&self.map, light);
        let guarded = light.check_border(extent);
        guarded.map_err(|error| unsuitable(error.to_string()))?;
        let bias = receiver_bias(&self.map, light, told.depth_format)?;
        let parameters = ViewParameters::new(told.camera, light, bias, told.leak_reduction);
        let mut parameters = parameters.map_err(|error| unsuitable(error.to_string()))?;
        let light = light.area_light(extent, self.radii.clone());
        parameters.light = light.map_err(|error| unsuitable(error.to_string()))?;
        Ok(parameters)
    }
}

/// Texels of the map that a view of a light has.
pub(super) fn extent(map: &TextureDesc, light: &LightView) -> [u32; 2] {
    if light.region == MapRegion::WHOLE {
        map.size
    } else {
        light.region.extent
    }
}

/// The receiver bias for a map and a view of a light: it follows from the filter, from the texels, and from how depth is stored.
pub(super) fn receiver_bias(
    map: &TextureDesc,
    light: &LightView,
    depth_format: Option<TextureFormat>,
) -> Result<ReceiverBias, GraphError> {
    let depth_per_texel = light.depth_per_texel(extent(map, light)) as f32;
    // Of a kernel with a width of its own, in the coarser direction.
    let texels = light.texel_size(extent(map, light));
    let own = Kernel::deviation_of_width(f64::from(map.width.get()) / texels[0].min(texels[1]));
    let deviation = map.deviation.get().hypot(own as f32);
    let bias = ReceiverBias::for_kernel(deviation, depth_per_texel);
    let conversion = light.depth.conversion();
    let conversion = conversion.map_err(|error| unsuitable("a view of a light", error))?;
    Ok(depth_format.map_or(bias, |format| bias.for_stored_depth(format, &conversion)))
}
