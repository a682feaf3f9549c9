//! The graph, and what is known of it before there is a camera.

use bevy::prelude::*;
use moment_shadows::{MapEncoding, TextureFormat};
use moment_shadows_graph::{
    Capabilities, Graph, GraphError, GraphErrorKind, PlannedWork, ResourceDesc, TextureDesc,
};

use crate::MomentShadowsPlugin;

/// The import that is Bevy's shadow map of directional and spot lights.
pub(crate) const LIGHT_DEPTH: &str = "light_depth";
/// The import that is what a camera sees.
pub(crate) const CAMERA_DEPTH: &str = "camera_depth";
/// The output that materials look up.
pub(crate) const SHADOW_MAP: &str = "shadow_map";
/// The output that is drawn over the picture.
pub(crate) const SCATTERING: &str = "scattering";

/// A graph that suits Bevy and the device.
#[derive(Resource)]
pub(crate) struct Compiled {
    /// The graph file's text: a session takes a graph for itself.
    pub(crate) text: String,
    graph: Graph,
    pub(crate) capabilities: Capabilities,
    /// The filtered map of a light's depth of [`NOMINAL`] texels, and how it is encoded.
    pub(crate) map: Option<(TextureDesc, MapEncoding)>,
    /// The pass that draws what the air adds.
    pub(crate) scattering: Option<String>,
    pub(crate) cameras: u32,
    pub(crate) layers: u32,
}

/// Width and height of the light's depth that the graph is compiled for at first.
const NOMINAL: u32 = 1024;

impl Compiled {
    pub(crate) fn new(
        plugin: &MomentShadowsPlugin,
        capabilities: Capabilities,
    ) -> Result<Self, GraphError> {
        let graph: Graph = plugin.graph.parse()?;
        for import in &graph.imports {
            if ![LIGHT_DEPTH, CAMERA_DEPTH].contains(&import.name.as_str()) {
                return Err(unsuitable(format!(
                    "Bevy has nothing for the import '{}'; there are '{LIGHT_DEPTH}' and '{CAMERA_DEPTH}'",
                    import.name
                )));
            }
        }
        for output in &graph.outputs {
            if ![SHADOW_MAP, SCATTERING].contains(&output.name.as_str()) {
                return Err(unsuitable(format!(
                    "nothing in Bevy takes the output '{}'; '{SHADOW_MAP}' is looked up by materials, '{SCATTERING}' drawn over the picture",
                    output.name
                )));
            }
        }
        if graph.outputs.is_empty() {
            return Err(unsuitable(format!(
                "it has no output; name one '{SHADOW_MAP}' or '{SCATTERING}'"
            )));
        }
        let depth = |layers| {
            let size = [NOMINAL; 2];
            let desc = TextureDesc::new(TextureFormat::Depth32Float, size);
            ResourceDesc::Texture(TextureDesc { layers, ..desc })
        };
        let imports = graph.imports.iter().map(|import| match &*import.name {
            LIGHT_DEPTH => (LIGHT_DEPTH, depth(plugin.layers)),
            _ => (CAMERA_DEPTH, depth(1)),
        });
        let imports: Vec<(&str, ResourceDesc)> = imports.collect();
        let plan = graph.compile(&capabilities, &imports)?;
        let map = match plan.output_texture(SHADOW_MAP) {
            None => None,
            Some(desc) => Some((desc.clone(), encoding(desc)?)),
        };
        let mut outputs = plan.outputs.iter();
        let drawn = outputs.find(|output| output.name == SCATTERING);
        let scattering = drawn.map(|output| {
            let of = |work: &PlannedWork| matches!(work, PlannedWork::Fullscreen { target, .. } if *target == output.value);
            let pass = plan.passes.iter().find(|pass| of(&pass.work));
            let pass = pass.map(|pass| pass.name());
            pass.ok_or_else(|| unsuitable(format!("the output '{SCATTERING}' is not that of a node 'composite_scattering'")))
        });
        Ok(Self {
            text: plugin.graph.clone(),
            graph,
            map,
            scattering: scattering.transpose()?,
            cameras: plugin.cameras.max(1),
            layers: plugin.layers.max(1),
            capabilities,
        })
    }

    pub(crate) fn imports(&self, name: &str) -> bool {
        self.graph.imports.iter().any(|import| import.name == name)
    }
}

/// How the map is encoded: four moments, where the graph does not say.
fn encoding(map: &TextureDesc) -> Result<MapEncoding, GraphError> {
    let encoding = map.encoding.clone();
    let encoding = encoding.or_else(|| MapEncoding::of_four_moments(map.format));
    let encoding = encoding.ok_or_else(|| {
        unsuitable(format!(
            "the output '{SHADOW_MAP}' ({}) is no map of moments; connect it to a node that makes or filters one",
            map.format
        ))
    })?;
    if encoding.technique().row().places_layers {
        return Err(unsuitable(
            "layers of 'lvsm' that are placed on the device are not looked up by materials; give uniform ones, or the splits",
        ));
    }
    Ok(encoding)
}

pub(crate) fn unsuitable(message: impl Into<String>) -> GraphError {
    GraphError::new(GraphErrorKind::Property, message)
}
