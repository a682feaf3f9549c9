//! Kernels of blurs whose width is given in scene units: one for each region and axis.

use moment_shadows::{Kernel, LightView};

use super::shading::extent;
use super::unsuitable;
use crate::nodes::Blur;
use crate::{GraphError, Plan, TextureDesc};

/// The struct `BlurParameters`.
pub(super) type Words = [u32; Blur::PARAMETER_WORDS];

/// A blur whose width is given in scene units.
#[derive(Debug)]
pub(super) struct SceneBlur {
    pub(super) node: String,
    map: TextureDesc,
    /// The standard deviation in scene units.
    width: f64,
    /// The largest radius in texels.
    largest: u32,
}

impl SceneBlur {
    /// Those of a plan.
    pub(super) fn all(plan: &Plan) -> Vec<Self> {
        let blocks = plan.parameters.blocks.iter();
        let blocks = blocks.filter(|block| block.name == "BlurParameters");
        let of = blocks.filter_map(|block| {
            // What the plan begins with: the widest kernel, and the width.
            let word = |index: usize| {
                let bytes = block.initial.get(4 * index..4 * index + 4)?;
                Some(u32::from_le_bytes(bytes.try_into().ok()?))
            };
            let width = f64::from(f32::from_bits(word(2)?));
            let name = format!("{}.blurred", block.node);
            let map = plan.resources.iter().find(|it| it.name == name)?;
            (width > 0.0).then_some(Self {
                node: block.node.clone(),
                map: map.desc.texture()?.clone(),
                width,
                largest: word(0)?,
            })
        });
        of.collect()
    }

    pub(super) fn layers(&self) -> u32 {
        self.map.layers
    }

    /// The structs of a layer's views, each along x and along y.
    pub(super) fn write<'a>(
        &self,
        kernels: &mut Vec<Words>,
        views: impl Iterator<Item = (usize, &'a LightView)>,
    ) -> Result<(), GraphError> {
        kernels.clear();
        for (index, view) in views {
            for texel in view.texel_size(extent(&self.map, view)) {
                let kernel = Kernel::of_width(self.width / texel, self.largest);
                let kernel = kernel.map_err(|error| {
                    let what = format_args!("view {index} of a light, for node '{}'", self.node);
                    let reason = format_args!(
                        "its texels are {texel} scene units wide: {error}; give the view fewer texels, or the blur a larger radius"
                    );
                    unsuitable(what, reason)
                })?;
                kernels.push(Blur::parameters(&kernel));
            }
        }
        Ok(())
    }
}
