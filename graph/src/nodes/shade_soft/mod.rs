//! Soft shadow intensity of every pixel from a summed-area table.

use moment_shadows::{MapEncoding, SummedAreaTable, TextureFormat};
use serde::{Deserialize, Serialize};

use super::shared::{FULLSCREEN, Specialization, shading};
use super::techniques;
use crate::{
    Binding, Connected, GraphError, GraphErrorKind, Node, NodeDesc, Rule, Slot, TextureRule, bind,
};

/// Node `shade_soft`: `table` (a summed-area table) and `camera_depth` to `shadow_intensity`, of the camera's size: penumbrae of
/// area lights, hard at contacts and softer with distance, with a number of loads per pixel that does not depend on their
/// width. A fullscreen pass: it can also be drawn into a render pass that the host has open.
///
/// Lights, views and parameters are those of [`super::ShadeHard`]: an array of [`moment_shadows::ViewParameters`], one per
/// view, whose `light` says how large the light is ([`moment_shadows::AreaLight`]). Of the receiver bias the constant counts
/// and the steepest slope, which [`moment_shadows::ReceiverBias::for_kernel`] with a standard deviation of 0 gives; the rest
/// follows from each pixel's own filter. No filter is larger than the table's largest kernel.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShadeSoft {
    /// The format of the shadow intensity, as that of [`super::ShadeHard`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub format: Option<TextureFormat>,
    /// The lights, 1 to 4.
    #[serde(default = "one")]
    pub lights: u32,
    /// The most views of all lights together.
    #[serde(default = "one")]
    pub views: u32,
    /// Which of the two queries of the table interpolate.
    #[serde(default)]
    pub interpolation: Interpolation,
}

/// Queries of a table that weight texels by the part that they cover, with 16 loads; the others count whole texels, with 4.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Interpolation {
    /// Blocker search and filter: no bands in penumbrae, however slowly they rise. 32 loads.
    Both,
    /// The filter alone: the width of a penumbra then changes in steps that its own slope hides. 20 loads.
    #[default]
    Filter,
    /// Neither: for filters of many texels. 8 loads.
    Neither,
}

impl Interpolation {
    /// Whether the blocker search interpolates, and whether the filter does.
    fn of_queries(self) -> [bool; 2] {
        match self {
            Interpolation::Both => [true, true],
            Interpolation::Filter => [false, true],
            Interpolation::Neither => [false, false],
        }
    }
}

fn one() -> u32 {
    1
}

impl Default for ShadeSoft {
    fn default() -> Self {
        Self {
            format: None,
            lights: 1,
            views: 1,
            interpolation: Interpolation::default(),
        }
    }
}

impl Node for ShadeSoft {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let format = shading::target_format(self.format, self.lights, self.views)?;
        let (encoding, table) = table_input(upstream)?;
        let specialization = self.specialization(upstream, table);
        let (specialization, modules) =
            techniques::soft_evaluation(specialization, encoding.technique())
                .map_err(|error| error.at_slot("table"))?;
        let [map, soft, receiver] = modules;
        let wgsl = specialization.link(shading::SHADER, &[FULLSCREEN, map, soft, receiver])?;
        let rule = TextureRule::new(encoding.format())
            .layers(Rule::Any)
            .mips(Rule::Any);
        Ok(shading::describe(
            "shade_soft",
            [Slot::input("table", "The light's summed-area table.", rule)],
            [Binding::new("table_sums", bind::layers("table"))],
            format,
            self.views,
            wgsl,
        ))
    }
}

impl ShadeSoft {
    fn specialization(&self, upstream: &Connected<'_>, table: SummedAreaTable) -> Specialization {
        let [width, height] = table.largest_kernel();
        let [search, filter] = self.interpolation.of_queries();
        Specialization::new(upstream.capabilities())
            // Filters are as wide as pixels are: there are no mip levels to choose from.
            .constant("LEVELS", "1u")
            .constant("ANISOTROPY", "1.0")
            .unsigned("VIEWS", self.views)
            .unsigned("LIGHTS", self.lights)
            .constant("LARGEST_KERNEL", &format!("vec2f({width}.0, {height}.0)"))
            .constant("TABLE_UNIT", &format!("f32({}u)", table.unit()))
            .constant("TABLE_ERROR", &format!("f32({:?})", table.error()))
            .constant("SEARCH_INTERPOLATED", &search.to_string())
            .constant("FILTER_INTERPOLATED", &filter.to_string())
    }
}

/// The table, and what it holds.
fn table_input(upstream: &Connected<'_>) -> Result<(MapEncoding, SummedAreaTable), GraphError> {
    let encoding = upstream.texture("table")?.encoding.as_ref();
    let table = encoding.and_then(|encoding| Some((encoding.clone(), *encoding.table()?)));
    table.ok_or_else(|| {
        GraphError::new(
            GraphErrorKind::Format,
            "soft shadows are made of a summed-area table; connect the output of a node 'summed_area_table'",
        )
        .at_slot("table")
    })
}
