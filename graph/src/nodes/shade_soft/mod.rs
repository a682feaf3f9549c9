//! Soft shadow intensity of every pixel from a summed-area table.

use moment_shadows::TextureFormat;
use serde::{Deserialize, Deserializer};

use super::shared::debug_view::DebugView;
use super::shared::{Specialization, map_input, range_input, shading, wrong_format};
use super::techniques;
use crate::{Binding, Connected, GraphError, Node, NodeDesc, Slot, bind};

/// Node `shade_soft`: `table` (a summed-area table) and `camera_depth` to `shadow_intensity`, of the camera's size: penumbrae of
/// area lights, hard at contacts and softer with distance, with a number of loads per pixel that does not depend on their
/// width. A fullscreen pass, which can also be drawn into a render pass that the host has open; of more than four lights a compute
/// pass.
///
/// Lights, views, parameters and the input `ranges` are those of [`super::ShadeHard`]; `light` of the parameters says how large the light is. Of the
/// receiver bias only the constant and the steepest slope count ([`moment_shadows::ReceiverBias::for_kernel`] with a deviation
/// of 0); the rest follows from each pixel's own filter. No filter is larger than the table's largest kernel.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct ShadeSoft {
    /// The format of the shadow intensity, as that of [`super::ShadeHard`].
    pub format: Option<TextureFormat>,
    /// The lights, 1 to 16: four in each output.
    pub lights: u32,
    /// The most views of all lights together, at most 256. From 8 on, a pixel tries those alone that may contain it: a pass finds them
    /// for each tile of 16x16 pixels.
    pub views: u32,
    /// Whether views blend and fade out along their borders, as in [`super::ShadeHard`].
    pub borders: bool,
    /// What the output `debug` shows of how pixels are shaded; without it there is no such output.
    pub debug: Option<DebugView>,
    /// Whether the two queries of the table, blocker search and filter, weight texels by the part that they cover, with 16
    /// loads; otherwise they count whole texels, with 4. In a file `"both"`: no bands in penumbrae, however slowly they rise;
    /// `"filter"`, the default: the width of a penumbra changes in steps that its own slope hides; or `"neither"`: for filters
    /// of many texels.
    #[serde(deserialize_with = "interpolation")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "interpolation_schema", extend("default" = "filter")))]
    pub interpolation: [bool; 2],
}

fn interpolation<'de, D: Deserializer<'de>>(file: D) -> Result<[bool; 2], D::Error> {
    #[derive(Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Queries {
        Both,
        Filter,
        Neither,
    }
    Ok(match Queries::deserialize(file)? {
        Queries::Both => [true, true],
        Queries::Filter => [false, true],
        Queries::Neither => [false, false],
    })
}

#[cfg(feature = "schema")]
fn interpolation_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    schemars::json_schema!({ "enum": ["both", "filter", "neither"] })
}

impl Default for ShadeSoft {
    fn default() -> Self {
        Self {
            format: None,
            lights: 1,
            views: 1,
            borders: false,
            debug: None,
            interpolation: [false, true],
        }
    }
}

impl Node for ShadeSoft {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let map = upstream.texture("table")?;
        let encoding = map.encoding.as_ref();
        let table = encoding.and_then(|encoding| Some((encoding, encoding.table()?)));
        let (encoding, table) = table.ok_or_else(|| {
            let message = "soft shadows are made of a summed-area table; connect the output of a node 'summed_area_table'";
            wrong_format(message).at_slot("table")
        })?;
        let [width, height] = table.largest_kernel();
        let [search, filter] = self.interpolation;
        let specialization = Specialization::new(upstream.capabilities())
            // Filters are as wide as pixels are: there are no mip levels to choose from.
            .constant("LEVELS", "1u")
            .constant("ANISOTROPY", "1.0")
            .constant(
                "LARGEST_KERNEL",
                format_args!("vec2f({width}.0, {height}.0)"),
            )
            .constant("TABLE_UNIT", format_args!("f32({}u)", table.unit()))
            .constant("TABLE_ERROR", format_args!("f32({:?})", table.error()))
            .constant("SEARCH_INTERPOLATED", search)
            .constant("FILTER_INTERPOLATED", filter);
        let specialization = techniques::soft_evaluation(specialization, encoding.technique())
            .map_err(|error| error.at_slot("table"))?;
        let (specialization, ranges, ranges_binding) =
            range_input::of_reader(specialization, upstream, map)?;
        let rule = map_input::rule(encoding.format());
        shading::describe(
            "shade_soft",
            upstream,
            shading::Settings {
                format: self.format,
                lights: self.lights,
                views: self.views,
                borders: self.borders,
                debug: self.debug,
            },
            (encoding.technique(), true),
            [
                Slot::input("table", "The light's summed-area table.", rule),
                ranges,
            ],
            core::iter::once(Binding::new("table_sums", bind::layers("table")))
                .chain(ranges_binding)
                .collect(),
            specialization,
        )
    }
}
