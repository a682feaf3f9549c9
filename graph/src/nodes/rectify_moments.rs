//! Resamples a light's map in the rectified coordinates of a camera.

use moment_shadows::{MapEncoding, RectifyMomentsParameters, Storage, Technique};
use serde::{Deserialize, Serialize};

use super::moments_input::{map_formats, moments_input};
use super::moments_lookup::moments_lookup;
use super::specialization::Specialization;
use super::{drawn_map, techniques};
use crate::{
    Access, Binding, BindingResource, Connected, CountRule, Direction, ExtentRule, FormatRule,
    GraphError, GraphErrorKind, Lifetime, Node, NodeDesc, ParameterBlock, Pass, Slot, SlotResource,
    Stage, Work,
};

/// Node `rectify_moments`: `moments` (four of them, filtered, of any storage) to `rectified`, a map whose columns are distances
/// from the light ray through the camera and whose rows are azimuths about it, as the WGSL module `rectified_frame`
/// describes. A first step to single scattering; [`super::IntegrateScattering`] is the second. Parameters:
/// [`RectifyMomentsParameters`].
///
/// Each texel is one light ray, looked up in the light's map over the texel's own footprint where that has mip levels; rays
/// outside of the map are lit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RectifyMoments {
    /// `hamburger4` or `hamburger6`: how many moments the two depths of a texel are encoded as again.
    #[serde(default)]
    pub technique: Technique,
    /// How they are stored: not as `unorm10`, since prefix sums are written by compute shaders.
    pub storage: Storage,
    /// Columns and rows, each from 2 to 8192.
    #[serde(default = "default_extent")]
    pub extent: [u32; 2],
}

fn default_extent() -> [u32; 2] {
    [512, 512]
}

/// Probes of a lookup in a map with mip levels.
const ANISOTROPY: u16 = 8;

impl Node for RectifyMoments {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (moments, source) = moments_input(upstream)?;
        if !source.technique().shares_map_with(&Technique::Hamburger4) {
            return Err(GraphError::new(
                GraphErrorKind::Format,
                format!(
                    "the map holds {source}; this node resamples four moments: give the node that makes the map the technique \
                     'hamburger4'"
                ),
            )
            .at_slot("map"));
        }
        let encoding = self.encoding()?;
        let texel = match self.technique {
            Technique::Hamburger6 => include_str!("scattering/rectified_six_moments.wgsl"),
            _ => include_str!("scattering/rectified_four_moments.wgsl"),
        };
        let capabilities = upstream.capabilities();
        let (lookup, sampler) =
            moments_lookup(moments.format, moments.mips, ANISOTROPY, true, capabilities);
        let specialization = Specialization::new(capabilities)
            .constant(
                "SOURCE_STORAGE",
                &format!("{}u", source.storage().wgsl_index()),
            )
            .constant("LEVELS", &format!("{}u", moments.mips))
            .constant("ANISOTROPY", &format!("{ANISOTROPY}.0"));
        let wgsl = techniques::specialize_map(specialization, &encoding).link(
            "rectify_moments.wgsl",
            include_str!("rectify_moments.wgsl"),
            &[("rectified_texel", texel), ("moments_lookup", lookup)],
        )?;
        let mut bindings = vec![
            BindingResource::Parameters,
            BindingResource::StorageLayer("rectified".to_owned()),
            BindingResource::Layers("map".to_owned()),
        ];
        bindings.extend(sampler);
        let bindings: Vec<Binding> = (0..)
            .zip(bindings)
            .map(|(binding, resource)| Binding { binding, resource })
            .collect();
        let passes = (0..encoding.planes())
            .map(|plane| {
                let (label, constants) = if techniques::encodes_planes(&self.technique) {
                    (
                        format!("rectify plane {plane}"),
                        [("PLANE".to_owned(), f64::from(plane))].into(),
                    )
                } else {
                    ("rectify".to_owned(), [].into())
                };
                Pass {
                    label,
                    wgsl: wgsl.clone(),
                    entry_point: "rectify".to_owned(),
                    bindings: bindings.clone(),
                    constants,
                    plane,
                    work: Work::Compute {
                        covers: "rectified".to_owned(),
                        texels_per_workgroup: [8, 8],
                        each_layer: false,
                    },
                }
            })
            .collect();
        Ok(NodeDesc {
            name: "rectify_moments".to_owned(),
            stage: Stage::AfterShadowMaps,
            slots: self.slots(encoding),
            passes,
            parameters: Some(ParameterBlock {
                name: "RectifyMomentsParameters".to_owned(),
                size: size_of::<RectifyMomentsParameters>() as u32,
                elements: 1,
                each_layer_of: None,
                initial: Vec::new(),
            }),
        })
    }
}

impl RectifyMoments {
    fn encoding(&self) -> Result<MapEncoding, GraphError> {
        let property = |message: String| GraphError::new(GraphErrorKind::Property, message);
        if !matches!(
            self.technique,
            Technique::Hamburger4 | Technique::Hamburger6
        ) {
            return Err(property(format!(
                "'technique' is '{}'; single scattering has both bounds of 'hamburger4' and 'hamburger6' alone",
                self.technique
            )));
        }
        if self.extent.iter().any(|side| !(2..=8192).contains(side)) {
            return Err(property(format!(
                "'extent' is {}x{}; columns and rows are 2 to 8192 each",
                self.extent[0], self.extent[1]
            )));
        }
        let encoding =
            MapEncoding::new(self.technique.clone(), self.storage).map_err(techniques::property)?;
        drawn_map::refuse_prefix_sums(&encoding, GraphErrorKind::Property)?;
        Ok(encoding)
    }

    fn slots(&self, encoding: MapEncoding) -> Vec<Slot> {
        let slot = |name: &str, direction, access, format, extent, count: fn() -> CountRule| Slot {
            name: name.to_owned(),
            direction,
            lifetime: Lifetime::Frame,
            optional: false,
            resource: SlotResource::Texture {
                access,
                format,
                extent,
                layers: count(),
                mips: count(),
                samples: CountRule::Exact(1),
            },
        };
        vec![
            slot(
                "map",
                Direction::In,
                Access::READ,
                FormatRule::OneOf(map_formats()),
                ExtentRule::Any,
                || CountRule::Any,
            ),
            slot(
                "rectified",
                Direction::Out,
                Access::STORAGE_WRITE,
                FormatRule::Encoded(encoding),
                ExtentRule::Exact(self.extent),
                || CountRule::Exact(1),
            ),
        ]
    }
}
