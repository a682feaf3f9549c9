//! Ways to march that are compared.

use moment_shadows::{Resolution, ScatteringWay, Storage, Technique};
use moment_shadows_graph::{Graph, NodeRegistry};
use serde_json::json;

use crate::error::LabError;
use crate::graph_file::GraphFile;
use crate::scattering::chain::Chain;

/// A graph that lights the air.
#[derive(Debug)]
pub struct MarchCandidate {
    /// What tables and files call it.
    pub name: String,
    /// Lookups of maps per pixel of the picture.
    pub lookups: f64,
    /// The way in the library's terms, of those with filtered maps.
    pub way: Option<ScatteringWay>,
    /// Whether it reads the plain depth map.
    pub(super) plain: bool,
    pub(super) file: GraphFile,
}

/// Steps at full resolution through the filtered map and through the plain one, and at parts of it.
const FILTERED: [u32; 5] = [4, 8, 16, 32, 64];
const PLAIN: [u32; 4] = [8, 16, 32, 64];
const PARTS: [u32; 3] = [8, 16, 32];

/// Columns and rows of the rectified map of prefiltered scattering.
const EXTENT: [u32; 2] = [512, 512];

/// Marching with a filtered map of four moments and with the plain map, at full resolution, at half and at a quarter of it, for a light with
/// so many `views`; where that is asked for, prefiltered scattering with six moments, too. `radius` is that of the blur.
pub fn march_candidates(
    views: usize,
    radius: u32,
    dithered: bool,
    prefiltered: bool,
) -> Result<Vec<MarchCandidate>, LabError> {
    let mut all = Vec::new();
    if prefiltered {
        let chain = Chain {
            map: Storage::Unorm16,
            radius: Some(radius),
            rectify: "rectify_moments",
            rectified: (Technique::Hamburger6, Storage::Float16),
            extent: EXTENT,
            seen: true,
            composite: "composite_scattering",
        };
        all.push(MarchCandidate {
            name: "prefiltered".to_owned(),
            lookups: 2.0,
            way: Some(ScatteringWay::Prefiltered),
            plain: false,
            file: chain.graph()?,
        });
    }
    for (resolution, part) in [
        (Resolution::Full, ""),
        (Resolution::Half, " half"),
        (Resolution::Quarter, " quarter"),
    ] {
        for (map, plain) in [("hamburger4", false), ("plain", true)] {
            let steps: &[u32] = match (resolution, plain) {
                (Resolution::Full, false) => &FILTERED,
                (Resolution::Full, true) => &PLAIN,
                (Resolution::Half | Resolution::Quarter, _) => &PARTS,
            };
            for &steps in steps {
                let per_texel = f64::from(resolution.pixels_per_texel());
                all.push(MarchCandidate {
                    name: format!("{map} {steps}{part}"),
                    lookups: f64::from(steps) / (per_texel * per_texel),
                    way: (!plain).then_some(ScatteringWay::Marched { steps, resolution }),
                    plain,
                    file: graph(views, radius, (plain, dithered), steps, resolution)?,
                });
            }
        }
    }
    Ok(all)
}

fn graph(
    views: usize,
    radius: u32,
    (plain, dithered): (bool, bool),
    steps: u32,
    resolution: Resolution,
) -> Result<GraphFile, LabError> {
    let mut march =
        json!({ "steps": steps, "views": views, "resolution": resolution, "dithered": dithered });
    let mut nodes = Vec::new();
    let mut edges = vec![json!({ "from": "camera_depth", "to": "march.camera_depth" })];
    if plain {
        march["technique"] = json!(Technique::Binary);
        edges.push(json!({ "from": "light_depth", "to": "march.depth" }));
    } else {
        nodes.push(json!({ "name": "resolve", "type": "resolve", "properties": { "storage": Storage::Unorm16 } }));
        nodes.push(json!({ "name": "blur", "type": "blur", "properties": { "kernel": { "radius": radius } } }));
        edges.push(json!({ "from": "light_depth", "to": "resolve.depth" }));
        edges.push(json!({ "from": "resolve.map", "to": "blur.map" }));
        edges.push(json!({ "from": "blur.blurred", "to": "march.map" }));
    }
    nodes.push(json!({ "name": "march", "type": "march_scattering", "properties": march }));
    let mut from = "march.scattering";
    if resolution != Resolution::Full {
        nodes.push(json!({ "name": "upsample", "type": "upsample_scattering" }));
        edges.push(json!({ "from": from, "to": "upsample.scattering" }));
        edges.push(json!({ "from": "camera_depth", "to": "upsample.camera_depth" }));
        from = "upsample.upsampled";
    }
    let text = json!({
        "version": 2,
        "imports": [{ "name": "light_depth" }, { "name": "camera_depth" }],
        "nodes": nodes,
        "edges": edges,
        "outputs": [{ "name": "scattering", "from": from }],
    })
    .to_string();
    let graph = Graph::parse(&text, &NodeRegistry::new()).map_err(LabError::graph("march"))?;
    Ok(GraphFile {
        name: "march".to_owned(),
        text,
        graph,
    })
}
