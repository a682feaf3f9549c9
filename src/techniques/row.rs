//! One row of the table of techniques: all that the library knows about a technique with its settings.

use super::Finite;
use crate::{Storage, ValueError};

/// How a map is made and filtered: expressions in WGSL, which can use whatever the library defines, and the row's constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Encoding {
    /// The channels to average for a moment depth `z`, a vec4f.
    pub channels: &'static str,
    /// The texel to write for the averages `mean` of channels, a vec4f.
    pub texel: &'static str,
    /// The value that a filter averages for a `texel`, a vec4f.
    pub filter_value: &'static str,
    /// The texel to write for an average `value` of such values, a vec4f.
    pub filter_texel: &'static str,
}

/// Texels that any filter averages as they are, samplers too.
pub(super) const LINEAR: Encoding = Encoding {
    channels: "",
    texel: "",
    filter_value: "texel",
    filter_texel: "storage_round_texel(value, STORAGE)",
};

/// A constant of the generated module that a row's pieces import.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Constant {
    /// Its name.
    pub name: &'static str,
    /// Its value, a WGSL expression.
    pub value: String,
    /// Whether the map depends on it, and not only how it is evaluated.
    pub of_map: bool,
}

impl Constant {
    pub(super) fn of_map(name: &'static str, value: impl ToString) -> Self {
        Self {
            name,
            value: value.to_string(),
            of_map: true,
        }
    }

    pub(super) fn of_evaluation(name: &'static str, value: impl ToString) -> Self {
        Self {
            name,
            value: value.to_string(),
            of_map: false,
        }
    }
}

/// How a map is evaluated that translucent casters were blended into.
#[derive(Clone, Copy, Debug)]
pub struct Blended {
    /// Whether the fourth channel of texels is free for a fragment's opacity.
    pub alpha_is_free: bool,
    /// As the row's evaluation, with the bias for `BLENDS` casters.
    pub(crate) evaluation: &'static str,
}

/// A technique with its settings. What a technique lacks is `None`, and a node refuses it for that.
#[derive(Clone, Debug)]
pub struct Row {
    /// The name in graph files and on command lines.
    pub name: &'static str,
    /// The storages of the map, the one with the least error per bit first. Empty where the plain depth map is read.
    pub storages: &'static [Storage],
    /// Further storages, of [rectified maps](crate::MapEncoding::rectified) alone: too coarse to be rounded more than once.
    pub rectified: &'static [Storage],
    /// Channels of a plane of the map: 1, 2 or 4.
    pub channels: u32,
    /// Texture layers that a layer of the map consists of.
    pub planes: u32,
    /// Whether the settings are within their ranges, whatever the storage.
    pub(super) settings: Result<(), ValueError>,
    /// Exponents, which are at least 1.
    pub(super) exponents: Vec<Finite>,
    /// The largest exponents that range and precision of each of `storages` allow; empty without exponents.
    pub(super) largest_exponents: &'static [f32],
    /// The texels, plane by plane, of a map in which everything is at the far end, for each of `storages` and of `rectified`.
    pub(super) far: Vec<Vec<[f64; 4]>>,
    /// Constants of the pieces below.
    pub(super) constants: Vec<Constant>,
    /// How the map is made and filtered; `None` where the plain depth map is read.
    pub(crate) encoding: Option<Encoding>,
    /// Whether channels are means of values in [-1, 1], whose storage in float32 is as fine as sums of f32 are.
    pub bounded_channels: bool,
    /// Whether a summed-area table can be made of the map.
    pub has_table: bool,
    /// Whether samplers and mip levels can average texels.
    pub averaged_by_samplers: bool,
    /// Whether both bounds of shadow intensity are there, as single scattering needs them.
    pub both_bounds: bool,
    /// Whether a comparison sampler reads the depth map, and whether that stores 1 at the near plane.
    pub comparison: Option<bool>,
    /// Whether the layers of the map are placed on the device (node `place_layers`).
    pub places_layers: bool,
    /// Shadow intensity of a `receiver`, by `map_texel(receiver, plane)` or on the plane `plane` of the plain depth map
    /// `depth_map`: the body of a function.
    pub(crate) evaluation: &'static str,
    /// The same for maps that translucent casters are blended into; `None` where none can be, or nothing is known of the bias.
    pub blended: Option<Blended>,
    /// The same for maps whose texels are rounded inwards; `None` where none are.
    pub(crate) rounded_inwards: Option<&'static str>,
    /// The same without a map, where `evaluation` filters its texels by itself.
    #[cfg_attr(
        not(feature = "validate"),
        expect(dead_code, reason = "exports read it")
    )]
    pub(crate) exported: Option<&'static str>,
    /// Functions of the library that belong to the technique and that nothing above reaches.
    #[cfg_attr(
        not(feature = "validate"),
        expect(dead_code, reason = "exports read it")
    )]
    pub(crate) functions: &'static [&'static str],
    /// The share and the mean moment depth of what blocks a `receiver`'s light, and half the width in texels of what is then filtered, a vec3f;
    /// `None` where nothing is searched for. By the table
    /// where the technique has soft shadows, otherwise as `evaluation`.
    pub(super) blockers: Option<&'static str>,
    /// The layer that shades a `receiver`, its neighbour and the share of that, a vec3f; `None` without layers.
    pub(super) layer: Option<&'static str>,
    /// Soft shadow intensity of a `receiver` from the summed-area table of the map, by `soft_table` and `soft_receiver`.
    pub(super) soft: Option<&'static str>,
}

impl Row {
    /// A row of a map that any filter averages, with one plane and no settings.
    pub(super) fn of_map(
        name: &'static str,
        storages: &'static [Storage],
        channels: u32,
        encoding: Encoding,
        evaluation: &'static str,
    ) -> Self {
        Self {
            name,
            storages,
            rectified: &[],
            channels,
            planes: 1,
            settings: Ok(()),
            exponents: Vec::new(),
            largest_exponents: &[],
            far: Vec::new(),
            constants: Vec::new(),
            encoding: Some(encoding),
            bounded_channels: false,
            has_table: false,
            averaged_by_samplers: true,
            both_bounds: false,
            comparison: None,
            places_layers: false,
            evaluation,
            blended: None,
            rounded_inwards: None,
            exported: None,
            functions: &[],
            blockers: None,
            layer: None,
            soft: None,
        }
    }

    /// A row of a test on the plain depth map.
    pub(super) fn of_depth(name: &'static str, evaluation: &'static str) -> Self {
        Self {
            encoding: None,
            averaged_by_samplers: false,
            ..Self::of_map(name, &[], 1, LINEAR, evaluation)
        }
    }

    /// Whether the technique reads the plain depth map instead of a filterable one.
    #[must_use]
    pub fn reads_depth(&self) -> bool {
        self.encoding.is_none()
    }

    /// The largest exponent that a storage of the technique allows; `None` for techniques without one.
    #[must_use]
    pub fn largest_exponent(&self, storage: Storage) -> Option<f32> {
        let index = self.storages.iter().position(|&of| of == storage)?;
        self.largest_exponents.get(index).copied()
    }

    /// The texel of each plane of a map that casts no shadow, since everything in it is at the far end; zeros where there are fewer
    /// channels. `None` for other storages than the technique's.
    #[must_use]
    pub fn far_texels(&self, storage: Storage) -> Option<&[[f64; 4]]> {
        let mut storages = self.storages.iter().chain(self.rectified);
        let index = storages.position(|&of| of == storage)?;
        self.far.get(index).map(Vec::as_slice)
    }

    /// Whether both techniques read the same map.
    #[must_use]
    pub fn shares_map_with(&self, other: &Row) -> bool {
        let of_map = |row: &Row| -> Vec<Constant> {
            let constants = row.constants.iter();
            constants.filter(|it| it.of_map).cloned().collect()
        };
        self.encoding == other.encoding
            && self.channels == other.channels
            && self.planes == other.planes
            && self.places_layers == other.places_layers
            && of_map(self) == of_map(other)
    }
}

/// Four of `values` from `first` on as a WGSL vector, with `missing` where there are none.
pub(super) fn vec4(values: &[f32], first: usize, missing: f32) -> String {
    let of = |index: usize| values.get(first + index).copied().unwrap_or(missing);
    format!("vec4f({:?}, {:?}, {:?}, {:?})", of(0), of(1), of(2), of(3))
}

/// A number as a WGSL literal.
pub(super) fn float(value: f32) -> String {
    format!("f32({value:?})")
}
