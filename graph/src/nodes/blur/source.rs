//! What a blur filters: a map, or a depth map that it resolves.

use moment_shadows::{MapEncoding, Storage, Technique};

use super::LARGEST_UNROLLED_RADIUS;
use crate::nodes::resolve::Resolved;
use crate::nodes::shared::{map_input, wrong_property};
use crate::nodes::{Resolve, techniques};
use crate::{
    Connected, GraphError, Off, ParameterBlock, Pass, Rule, Slot, TextureDesc, TextureRule,
};

/// What is connected, and what is made of it.
pub(super) struct Source<'a> {
    /// The input that the passes cover.
    pub(super) slot: &'static str,
    /// What is connected to it.
    pub(super) desc: &'a TextureDesc,
    /// How the map is encoded.
    pub(super) encoding: MapEncoding,
    /// How the map between the passes is encoded.
    pub(super) half: MapEncoding,
    /// All inputs.
    pub(super) inputs: Vec<Slot>,
    /// The map that is made.
    pub(super) made: TextureRule,
    resolved: Option<Resolved<'a>>,
}

impl<'a> Source<'a> {
    /// A map.
    pub(super) fn map(upstream: &Connected<'a>) -> Result<Self, GraphError> {
        let (desc, encoding) = map_input::connected(upstream, "map")?;
        map_input::refuse_written_once(&encoding)?;
        let encoding = encoding.rounded_again();
        let rule = map_input::rule(map_input::all_formats());
        Ok(Self {
            slot: "map",
            desc,
            half: encoding.clone(),
            encoding,
            inputs: vec![Slot::input("map", "The map to filter.", rule)],
            made: TextureRule::new(Rule::same_as("map")).like("map"),
            resolved: None,
        })
    }

    /// A depth map, by a kernel whose weights are literals; texels are rounded inwards or to the nearest.
    pub(super) fn resolved(
        resolve: &Resolve,
        upstream: &Connected<'a>,
        is_literal: bool,
        rounded_inwards: bool,
    ) -> Result<Self, GraphError> {
        let once = resolve.storage.iter().find(|it| it.is_written_once());
        let instead = once.map_or(String::new(), |storage| {
            format!(" with another storage than '{storage}', which is written once")
        });
        let refused = |message: &str| {
            Err(wrong_property(format!(
                "'resolve' {message} take a node 'resolve' and a blur of its map{instead}"
            )))
        };
        if resolve.blends > 0 {
            return refused(
                "has 'blends', but no translucent caster can be blended into a map between resolving and filtering in one pass;",
            );
        }
        if resolve.mip_levels != Some(1) {
            return refused(
                "has 'mip_levels', but the map is this node's, whose own 'mip_levels' count; give them there, or",
            );
        }
        if !is_literal {
            return refused(&format!(
                "goes with a kernel of at most radius {LARGEST_UNROLLED_RADIUS} that stays as it is, and this one's weights are \
                 parameters;"
            ));
        }
        let encoding = resolve.encoding_of_blur(upstream.capabilities());
        let encoding = encoding.map_err(wrong_property)?;
        let mut resolved = resolve.resolved(upstream, encoding, |encoding| {
            half(encoding, rounded_inwards)
        })?;
        if rounded_inwards {
            let inwards = resolved.encoding.rounded_inwards();
            resolved.encoding = inwards.map_err(wrong_property)?;
        }
        let encoding = resolved.encoding.clone();
        if encoding.storage().is_drawn() {
            return refused(&format!(
                "makes a map as '{}', which is drawn: each pixel would encode all texels under the kernel anew;",
                encoding.storage()
            ));
        }
        Ok(Self {
            slot: "depth",
            desc: resolved.depth,
            half: resolved.written.clone(),
            encoding,
            inputs: resolved.inputs().collect(),
            made: resolved.map(),
            resolved: Some(resolved),
        })
    }

    /// The depth map that the first direction resolves, if it does.
    pub(super) fn depth(&self) -> Option<&Resolved<'a>> {
        self.resolved.as_ref()
    }

    /// Whether the second direction reads packed texels and writes others.
    pub(super) fn repacks(&self) -> bool {
        self.half.storage() != self.encoding.storage()
    }

    /// A pass that is told which plane it encodes, where it resolves and the encoding asks.
    pub(super) fn of_plane(&self, pass: Pass) -> Pass {
        let encodes = pass.bindings.iter().any(|it| it.variable == "conversions");
        if encodes && self.encoding.technique().row().encodes_planes() {
            let plane = pass.plane;
            return pass.constant("PLANE", plane);
        }
        pass
    }

    /// What stands in for a blurred map of so many mip levels where the node is left out. A map without the levels that this one has
    /// room for is no stand-in.
    pub(super) fn off(&self, mips: u32) -> Option<Off> {
        match &self.resolved {
            Some(_) => Some(techniques::no_shadow(&self.encoding)),
            None => (mips == self.desc.mips).then(|| Off::Bypass(self.slot.to_owned())),
        }
    }

    /// How depths are stored, where they are resolved.
    pub(super) fn conversions(&self) -> Option<ParameterBlock> {
        self.resolved.as_ref().map(Resolved::conversions)
    }
}

/// How the map between the passes is encoded: as packed texels, which are almost exact, where those of the map are rounded inwards or once
/// alone; otherwise as the map.
fn half(encoding: &MapEncoding, rounded_inwards: bool) -> MapEncoding {
    let packed = MapEncoding::new(Technique::Hamburger4, Storage::Packed64).ok();
    let packed = packed.filter(|_| rounded_inwards || encoding.storage().is_written_once());
    packed.unwrap_or_else(|| encoding.clone())
}
