//! Turns a light's depth map into a map of moments.

use core::fmt;
use moment_shadows::{MapEncoding, Profile, Storage, Technique, ValueError};
use serde::de::value::SeqAccessDeserializer;
use serde::de::{self, IntoDeserializer, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::shared::{depth_input, mip_levels, regions, wrong_property};
use super::techniques;
use crate::{Connected, GraphError, Node, NodeDesc, Stage, TextureRule, bind};

/// Node `resolve`: `depth` (of any number of layers and samples) to
/// `map`, a filterable map of the same size, layers and regions, encoded for a technique. The *moments* (or what else the
/// technique stores) of the samples are averaged, not their depths, so edges are antialiased. With splits placed by Lloyd
/// relaxation there is a second input, `splits`. Parameters: a [`moment_shadows::DepthConversion`] per layer and region.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Resolve {
    /// What the map is made for; nodes that read it need not be told.
    #[serde(default)]
    pub technique: Technique,
    /// How the moments are stored: the first of these that the device can write. Empty, or `"best"` in a file, where it is
    /// left to the library: that with the least error per bit.
    #[serde(default, deserialize_with = "storages")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "storages_schema", extend("default" = "best")))]
    pub storage: Vec<Storage>,
    /// Room for mip levels, for a map that is not blurred, as that of [`super::Blur`].
    #[serde(default = "mip_levels::one", deserialize_with = "mip_levels::read")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "mip_levels::schema"))]
    pub mip_levels: Option<u32>,
}

fn storages<'de, D: Deserializer<'de>>(file: D) -> Result<Vec<Storage>, D::Error> {
    file.deserialize_any(Storages)
}

#[cfg(feature = "schema")]
fn storages_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let storage = generator.subschema_for::<Storage>();
    schemars::json_schema!({
        "anyOf": [{ "const": "best" }, storage, { "type": "array", "items": storage }],
    })
}

/// A storage, several in the order of preference, or `"best"`.
struct Storages;

impl<'de> Visitor<'de> for Storages {
    type Value = Vec<Storage>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a storage, a list of storages or \"best\"")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Vec<Storage>, E> {
        if name == "best" {
            return Ok(Vec::new());
        }
        Ok(vec![Storage::deserialize(name.into_deserializer())?])
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Vec<Storage>, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list))
    }
}

impl Resolve {
    /// How the map is encoded on a device of the profile; if the device can write none of the storages, as the last one.
    ///
    /// # Errors
    /// [`ValueError`], if the technique has not one of the storages, or its settings are out of range.
    pub fn encoding(&self, profile: Profile) -> Result<MapEncoding, ValueError> {
        let storages = match self.storage.as_slice() {
            [] => self.technique.row().storages,
            given => given,
        };
        let encodings = storages
            .iter()
            .map(|&storage| MapEncoding::new(self.technique.clone(), storage))
            .collect::<Result<Vec<_>, _>>()?;
        let written = encodings.iter().find(|it| it.check(profile).is_ok());
        match written.or(encodings.last()) {
            Some(encoding) => Ok(encoding.clone()),
            // A technique that reads the plain depth map has no storages; whatever is asked of it says so.
            None => MapEncoding::new(self.technique.clone(), Storage::Float32),
        }
    }
}

impl Node for Resolve {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let depth = upstream.texture("depth")?;
        let mips = mip_levels::count(self.mip_levels, depth.size)?;
        let technique = &self.technique;
        let profile = upstream.capabilities().profile;
        let encoding = self.encoding(profile).map_err(wrong_property)?;
        let wgsl = techniques::of_map(upstream.capabilities(), &encoding)
            .alias("DepthTexture", depth_input::texture_type(depth))
            .unsigned("REGIONS", depth.regions)
            .constant("SAMPLES", depth.samples)
            .module("technique_layers", techniques::layers(technique, true))
            .module("written_texel", include_str!("resolve_texel.wgsl"))
            .link(regions::shader(&encoding))?;
        let (splits, splits_binding) = techniques::splits(technique, true);
        let mut pass = regions::write("resolve", &wgsl, &encoding, ("map", 0), [8, 8], 1)
            .bind("conversions", bind::parameters())
            .bind("depth_map", bind::layer("depth"));
        pass.bindings.extend(splits_binding);
        let map = TextureRule::of_map(encoding.clone())
            .like("depth")
            .mips(mips);
        let description = "The filterable map, of the depth map's size, layers and regions.";
        Ok(NodeDesc::new("resolve", Stage::AfterShadowMaps)
            .input("depth", "The light's depth map.", depth_input::light())
            .output("map", description, map)
            .slots(splits)
            .passes(techniques::of_each_plane(&encoding, pass))
            .parameters(depth_input::conversions(depth))
            .off("map", techniques::no_shadow(&encoding)))
    }
}
