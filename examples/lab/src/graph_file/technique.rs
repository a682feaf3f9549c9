//! A graph with another technique than its own.

use moment_shadows::{EsmFiltering, Kernel, LayerSplits, MapEncoding, Profile, Storage, Technique};
use moment_shadows_graph::Capabilities;
use moment_shadows_graph::nodes::Resolve;
use serde_json::{Value, json};

use super::{GraphFile, items, push, remove_property};
use crate::error::LabError;

/// The node that places layers, where a technique needs one.
const PLACE: &str = "lab_place_layers";

/// The largest radius of a blur that resolves.
pub(crate) const LARGEST_RESOLVED_RADIUS: u32 = 12;

impl GraphFile {
    /// This graph with a technique in place of its own. A filterable one makes its map in `storage`, or in that of the
    /// graph. One that reads the plain depth map is connected to it; what made the filterable map has no reader then and is
    /// culled.
    pub fn with_technique(
        &self,
        technique: &Technique,
        storage: Option<Storage>,
    ) -> Result<Self, LabError> {
        if let Some(file) = storage.map_or(Ok(None), |it| self.written_once(it))? {
            return file.with_technique(technique, storage);
        }
        let resolve = match self.blur_that_resolves() {
            Some(blur) => name(&blur),
            None => self.name_of("resolve")?,
        };
        // Only hard shadows can do without a filterable map.
        let shade = match self.name_of("shade_soft") {
            Ok(shade) if !technique.reads_depth() => shade,
            _ => self.name_of("shade_hard")?,
        };
        let logarithmic = matches!(
            technique,
            Technique::Esm {
                filtering: EsmFiltering::Logarithmic,
                ..
            }
        );
        // Logarithms have no mip levels.
        let without_mip_levels = logarithmic.then(|| self.without_mip_levels()).transpose()?;
        let file = without_mip_levels.as_ref().unwrap_or(self);
        let depth = file
            .find("edges", "to", &format!("{resolve}.depth"))
            .map(|edge| edge["from"].clone())
            .ok_or_else(|| self.unsuitable(format!("no edge leads to the depth of '{resolve}'")))?;
        file.edited(|file| {
            for node in items(file, "nodes") {
                if node["name"] == shade.as_str() && technique.reads_depth() {
                    node["properties"]["technique"] = json!(technique);
                } else if node["name"] == shade.as_str() {
                    // It follows the map.
                    remove_property(node, "technique");
                } else if node["name"] == resolve.as_str() && !technique.reads_depth() {
                    let properties = told_how_to_resolve(node);
                    properties["technique"] = json!(technique);
                    if let Some(properties) = properties.as_object_mut() {
                        properties.remove("bits");
                    }
                    if let Some(storage) = storage {
                        properties["storage"] = json!(storage);
                    }
                    round_as_can_be(node);
                }
            }
            let mut added = Vec::new();
            let mut connect = |from: Value, to: String| added.push(json!({ "from": from, "to": to }));
            if technique.reads_depth() {
                connect(depth.clone(), format!("{shade}.depth"));
            }
            if let Technique::Lvsm {
                layers,
                splits: LayerSplits::Lloyd,
                ..
            } = technique
            {
                let node = json!({ "name": PLACE, "type": "place_layers", "properties": { "layers": layers } });
                push(file, "nodes", node);
                connect(depth.clone(), format!("{PLACE}.depth"));
                for reader in [&resolve, &shade] {
                    connect(json!(format!("{PLACE}.splits")), format!("{reader}.splits"));
                }
            }
            if let Some(edges) = file["edges"].as_array_mut() {
                let map = format!("{shade}.map");
                edges.retain(|edge| !(technique.reads_depth() && edge["to"] == map.as_str()));
                edges.extend(added);
            }
        })
    }

    /// Whether this graph makes a map in a storage: one that is written once needs a blur that can resolve.
    #[must_use]
    pub fn makes(&self, storage: Option<Storage>) -> bool {
        if !storage.is_some_and(Storage::is_written_once) {
            return true;
        }
        let Some(blur) = self.node_of("blur") else {
            return false;
        };
        let is_literal = !matches!(blur["properties"]["per_frame"], Value::Bool(true));
        let kernel = self.kernel().ok().flatten();
        let is_narrow = kernel.is_some_and(|it| it.radius() <= LARGEST_RESOLVED_RADIUS);
        is_literal && is_narrow && self.node_of("downsample").is_none()
    }

    /// This graph with its blur in place of the node that resolves before it, where only that makes a map in the storage.
    pub(super) fn written_once(&self, storage: Storage) -> Result<Option<Self>, LabError> {
        let is_told = !storage.is_written_once() || self.blur_that_resolves().is_some();
        match is_told {
            true => Ok(None),
            false => self.resolved_by_the_blur().map(Some),
        }
    }

    /// This graph with its blur in place of the node that resolves before it.
    pub fn resolved_by_the_blur(&self) -> Result<Self, LabError> {
        let [resolve, blur] = [self.name_of("resolve")?, self.name_of("blur")?];
        let properties = match self.node_entry(&resolve, "properties") {
            Value::Null => json!({}),
            given => given,
        };
        self.edited(|file| {
            for node in items(file, "nodes").filter(|node| node["name"] == blur.as_str()) {
                node["properties"]["resolve"] = properties.clone();
            }
            if let Some(nodes) = file["nodes"].as_array_mut() {
                nodes.retain(|node| node["name"] != resolve.as_str());
            }
            if let Some(edges) = file["edges"].as_array_mut() {
                edges.retain(|edge| edge["to"] != format!("{blur}.map"));
            }
            for edge in items(file, "edges") {
                let to = edge["to"].as_str().unwrap_or_default();
                if let Some(slot) = to.strip_prefix(&format!("{resolve}.")) {
                    edge["to"] = format!("{blur}.{slot}").into();
                }
            }
        })
    }

    /// How the graph's map is encoded; none where no node makes one.
    #[must_use]
    pub fn encoding(&self) -> Option<MapEncoding> {
        let properties = match self.node_of("resolve") {
            Some(node) => match node["properties"].clone() {
                Value::Null => json!({}),
                given => given,
            },
            None => self.blur_that_resolves()?["properties"]["resolve"].clone(),
        };
        let resolve: Resolve = serde_json::from_value(properties).ok()?;
        resolve
            .encoding(&Capabilities::of_profile(Profile::Native))
            .ok()
    }

    /// The technique that the graph shades with.
    #[must_use]
    pub fn technique(&self) -> Option<Technique> {
        let shade = self.node_of("shade_hard")?;
        let own = serde_json::from_value(shade["properties"]["technique"].clone()).ok();
        own.or_else(|| self.encoding().map(|encoding| encoding.technique().clone()))
    }

    /// Whether the graph shades with the plain depth map, which has one sample per texel then.
    #[must_use]
    pub fn reads_depth(&self) -> bool {
        self.technique()
            .is_some_and(|technique| technique.reads_depth())
    }

    /// Samples per texel of the light's map, if `wished` are asked for.
    #[must_use]
    pub fn samples(&self, wished: u32) -> u32 {
        if self.reads_depth() { 1 } else { wished }
    }

    /// The smallest profile under which a device can make the graph's map, and has so many samples per texel.
    #[must_use]
    pub fn profile(&self, samples: u32) -> Profile {
        if matches!(samples, 2 | 8) {
            return Profile::NativeAdapter;
        }
        let encoding = self.encoding();
        let offers = |profile: &Profile| match &encoding {
            Some(encoding) => encoding.check(*profile).is_ok(),
            None => true,
        };
        Profile::ALL
            .into_iter()
            .find(offers)
            .unwrap_or(Profile::NativeAdapter)
    }

    /// How often the graph has to be recorded until what it keeps from frame to frame has settled.
    #[must_use]
    pub fn frames(&self) -> u32 {
        match self.node_of("place_layers") {
            // Two splits of at most seven move per frame.
            Some(_) => 64,
            None => 1,
        }
    }

    /// The kernel's radius; 0 without one.
    pub fn radius(&self) -> Result<u32, LabError> {
        Ok(self.kernel()?.as_ref().map_or(0, Kernel::radius))
    }

    pub(crate) fn node_of(&self, node_type: &str) -> Option<Value> {
        self.find("nodes", "type", node_type)
    }

    /// The blur that resolves by itself, if one does.
    pub(super) fn blur_that_resolves(&self) -> Option<Value> {
        let blur = self.node_of("blur")?;
        resolves(&blur).then_some(blur)
    }

    fn name_of(&self, node_type: &str) -> Result<String, LabError> {
        let node = self.node_of(node_type).ok_or_else(|| {
            self.unsuitable(format!(
                "it has no {node_type} node whose technique could be another; add one"
            ))
        })?;
        Ok(name(&node))
    }

    pub(crate) fn unsuitable(&self, reason: impl ToString) -> LabError {
        LabError::unsuitable(&self.name, reason)
    }
}

fn name(node: &Value) -> String {
    node["name"].as_str().unwrap_or_default().to_owned()
}

/// Whether a node resolves a depth map: a node `resolve`, or a blur that does so by itself.
pub(super) fn resolves(node: &Value) -> bool {
    node["type"] == "resolve" || !node["properties"]["resolve"].is_null()
}

/// Leaves out that a blur rounds texels inwards, where it cannot for what it is told to resolve for.
pub(super) fn round_as_can_be(node: &mut Value) {
    let resolve: Option<Resolve> =
        serde_json::from_value(node["properties"]["resolve"].clone()).ok();
    let can = resolve.is_some_and(|resolve| {
        let technique = resolve.technique.unwrap_or_default();
        let mut storages = resolve.storage.into_iter();
        storages.all(|storage| {
            let encoding = MapEncoding::new(technique.clone(), storage);
            encoding.and_then(MapEncoding::rounded_inwards).is_ok()
        })
    });
    if !can {
        remove_property(node, "rounded_inwards");
    }
}

/// What a node is told that resolves.
pub(super) fn told_how_to_resolve(node: &mut Value) -> &mut Value {
    let properties = &mut node["properties"];
    if properties["resolve"].is_null() {
        properties
    } else {
        &mut properties["resolve"]
    }
}
