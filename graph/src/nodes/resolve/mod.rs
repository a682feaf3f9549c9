//! Turns a light's depth map into a map of moments.

mod best;
mod resolved;

use moment_shadows::{MapEncoding, Storage, Technique, ValueError};
use serde::Deserialize;

pub(super) use resolved::Resolved;

use super::shared::{mip_levels, regions, wrong_property};
use super::techniques;
use crate::{Capabilities, Connected, GraphError, Node, NodeDesc, Stage};

/// Node `resolve`: `depth` (of any number of layers and samples) to
/// `map`, a filterable map of the same size, layers and regions, encoded for a technique. The *moments* (or what else the
/// technique stores) of the samples are averaged, not their depths, so edges are antialiased. With splits placed by Lloyd
/// relaxation there is a second input, `splits`. With the optional input `ranges` ([`super::FitRange`]) depths are those of the range that
/// casters take. Parameters: a [`moment_shadows::DepthConversion`] per layer and region.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Resolve {
    /// What the map is made for; nodes that read it need not be told. None, or `"best"` in a file, where it is left to the
    /// library with its storage: those with the least error for the bits on devices of the profile, as recorded, and beside `mip_levels` those
    /// that samplers average.
    #[serde(default = "best::usual", deserialize_with = "best::technique")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "best::technique_schema", extend("default" = "hamburger4")))]
    pub technique: Option<Technique>,
    /// With `"best"`: how many bits a texel of the map has at most, all planes; 64 where it is left out.
    #[serde(default)]
    pub bits: Option<u32>,
    /// How the moments are stored: the first of these that the device can write. Empty, or `"best"` in a file, where it is
    /// left to the library: that with the least error per bit. Beside the technique `"best"`: one of these, whichever errs least.
    #[serde(default, deserialize_with = "best::storages")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "best::storages_schema", extend("default" = "best")))]
    pub storage: Vec<Storage>,
    /// How many translucent casters are blended into the map over each other, at most: the node [`super::TranslucentCasters`] comes
    /// next. The bias grows with their number, and the storage is one that the device can blend.
    #[serde(default)]
    pub blends: u32,
    /// Room for mip levels, for a map that is not blurred, as that of [`super::Blur`].
    #[serde(default = "mip_levels::one", deserialize_with = "mip_levels::read")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "mip_levels::schema"))]
    pub mip_levels: Option<u32>,
}

impl Resolve {
    /// How the map is encoded on a device of these capabilities; if the device can make none of the storages, as the last one.
    ///
    /// # Errors
    /// [`ValueError`], if the technique has not one of the storages, its settings are out of range, no map has so few
    /// bits, or no translucent casters are blended into it.
    pub fn encoding(&self, capabilities: &Capabilities) -> Result<MapEncoding, ValueError> {
        self.encoding_written(capabilities, false)
    }

    /// The same for a blur that resolves, to which `"best"` is also a map that is written once.
    pub(super) fn encoding_of_blur(
        &self,
        capabilities: &Capabilities,
    ) -> Result<MapEncoding, ValueError> {
        self.encoding_written(capabilities, true)
    }

    fn encoding_written(
        &self,
        capabilities: &Capabilities,
        once: bool,
    ) -> Result<MapEncoding, ValueError> {
        let profile = capabilities.profile;
        let Some(technique) = &self.technique else {
            if self.blends > 0 {
                let message = "beside \"best\", which is known for opaque casters; name a technique, 'hamburger6' for most scenes";
                return Err(ValueError::new("'blends'", message));
            }
            return self.best(profile, once);
        };
        if let Some(bits) = self.bits {
            let message = format!(
                "{bits} beside the technique '{}'; it goes with \"best\"",
                technique.name()
            );
            return Err(ValueError::new("'bits'", message));
        }
        let storages = match self.storage.as_slice() {
            [] => technique.row().storages,
            given => given,
        };
        // Where none is asked for, those that the casters are blended into.
        let suits = |it: &&Storage| !self.storage.is_empty() || self.blends == 0 || !it.is_packed();
        let encodings = storages
            .iter()
            .filter(suits)
            .map(|&storage| MapEncoding::new(technique.clone(), storage)?.with_blends(self.blends))
            .collect::<Result<Vec<_>, _>>()?;
        let blended =
            |it: &MapEncoding| self.blends == 0 || capabilities.support(it.format()).blendable;
        let written = encodings
            .iter()
            .find(|it| it.check(profile).is_ok() && blended(it));
        match written.or(encodings.last()) {
            Some(encoding) => Ok(encoding.clone()),
            // A technique that reads the plain depth map has no storages; whatever is asked of it says so.
            None => MapEncoding::new(technique.clone(), Storage::Float32),
        }
    }
}

impl Node for Resolve {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let encoding = self.encoding(upstream.capabilities());
        let encoding = encoding.map_err(wrong_property)?;
        if encoding.storage().is_written_once() {
            return Err(wrong_property(format!(
                "'storage': '{0}' is rounded too coarsely to be filtered afterwards; give a node 'blur' the property 'resolve' with it \
                 ({{ \"storage\": \"{0}\" }}) in place of this node, or take another storage",
                encoding.storage()
            )));
        }
        let resolved = self.resolved(upstream, encoding, MapEncoding::clone)?;
        let mips = mip_levels::count(self.mip_levels, resolved.depth.size)?;
        let encoding = &resolved.encoding;
        let wgsl = resolved
            .specialization
            .clone()
            .module("written_texel", include_str!("resolve_texel.wgsl"))
            .link(regions::shader(encoding))?;
        let mut pass = regions::write("resolve", &wgsl, encoding, ("map", 0), [8, 8], 1);
        pass.bindings.extend(resolved.bindings());
        let description = "The filterable map, of the depth map's size, layers and regions.";
        // The splits and ranges come after the output.
        let mut inputs = resolved.inputs();
        Ok(NodeDesc::new("resolve", Stage::AfterShadowMaps)
            .slots(inputs.next())
            .output("map", description, resolved.map().mips(mips))
            .slots(inputs)
            .passes(techniques::of_each_plane(encoding, pass))
            .parameters(resolved.conversions())
            .off("map", techniques::no_shadow(encoding)))
    }
}
