//! Filters a map of moments with a separable kernel.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{Kernel, LARGEST_RADIUS, MapEncoding};
use serde::{Deserialize, Serialize};

use super::moments_input::{map_formats, moments_input};
use super::specialization::{FULLSCREEN, Specialization};
use super::unrolled::{self, Sums};
use super::{KernelProperty, MipLevels, drawn_map, region_tiles, techniques};
use crate::{
    Access, Binding, BindingResource, Connected, CountRule, Direction, ExtentRule, FormatRule,
    GraphError, GraphErrorKind, Lifetime, Node, NodeDesc, ParameterBlock, Pass, Slot, SlotResource,
    Stage, TextureDesc,
};

const UNROLLED_SHADER: &str = include_str!("blur_unrolled.wgsl");
const TARGET: &str = include_str!("blur_target.wgsl");
const UNIFORM_SHADER: &str = include_str!("blur_uniform.wgsl");
const PARAMETERS: (&str, &str) = ("blur_parameters", include_str!("blur_parameters.wgsl"));
const DRAWN_SHADER: &str = include_str!("blur_drawn.wgsl");
const DRAWN_TEXEL: &str = include_str!("blur_texel_uniform.wgsl");

/// Up to this radius the weights are literals and every load is unrolled; beyond it the code would leave the instruction
/// cache.
const LARGEST_UNROLLED_RADIUS: u32 = 12;

/// Invocations of a workgroup in x and y.
const WORKGROUP: [u32; 2] = [8, 8];

/// Along y with few taps: the invocations of a workgroup load one row at a time, in whole cache lines. With many taps the
/// texels that lie above each other are worth more, and a square has more of them.
const WORKGROUP_UNROLLED_Y: [u32; 2] = [64, 1];

/// Node `blur`: `moments` to `blurred`, of the same format, size, layers and regions. Two passes, along x and along
/// y, for each plane; beyond the edge of a region its last texel repeats. Maps stored as `unorm10` are drawn, others are written by
/// compute shaders.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Blur {
    /// The kernel, the same along both axes.
    pub kernel: KernelProperty,
    /// Whether the kernel can change per frame: its weights are then a node parameter ([`BlurParameters`]), which begins
    /// as `kernel`. Kernels of a radius above 12 have the parameter in any case.
    #[serde(default)]
    pub per_frame: bool,
    /// Room for mip levels; [`super::Downsample`] fills it.
    #[serde(default)]
    pub mip_levels: MipLevels,
}

/// Weights that a [`Blur`] node takes from its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct BlurParameters {
    /// Texels on either side of the centre.
    pub radius: u32,
    /// Blocks of 16 taps that the shader runs through.
    pub blocks: u32,
    /// Unused; keeps the WGSL layout.
    pub padding: [u32; 2],
    /// The weights, preceded by 15 zeros and followed by zeros.
    pub weights: [[f32; 4]; BLUR_WEIGHT_VECTORS],
}

/// 16-tap blocks of the largest kernel, and one more that the last outputs reach into.
const BLUR_WEIGHT_VECTORS: usize =
    4 * (LARGEST_RADIUS as usize * 2 + unrolled::OUTPUTS_UNIFORM).div_ceil(16) + 4;

impl BlurParameters {
    /// The parameters that stand for a kernel.
    #[must_use]
    pub fn new(kernel: &Kernel) -> Self {
        let mut flat = [0.0; BLUR_WEIGHT_VECTORS * 4];
        let before = unrolled::OUTPUTS_UNIFORM - 1;
        for (slot, &weight) in flat[before..].iter_mut().zip(kernel.weights()) {
            *slot = weight;
        }
        let taps = 2 * kernel.radius() as usize + unrolled::OUTPUTS_UNIFORM;
        Self {
            radius: kernel.radius(),
            blocks: taps.div_ceil(16) as u32,
            padding: [0; 2],
            weights: bytemuck::cast(flat),
        }
    }
}

impl Node for Blur {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (moments, encoding) = moments_input(upstream)?;
        let kernel = self.kernel.kernel()?;
        check_fits(&kernel, moments)?;
        let mips = self.mip_levels.count(moments.size)?;
        let unrolled = !self.per_frame && kernel.radius() <= LARGEST_UNROLLED_RADIUS;
        let along = ALONG
            .iter()
            .map(|along| along.pass(upstream, moments, &encoding, &kernel, unrolled))
            .collect::<Result<Vec<_>, _>>()?;
        // The planes take turns with one intermediate map.
        let passes = (0..moments.planes)
            .flat_map(|plane| along.iter().map(move |pass| (plane, pass)))
            .map(|(plane, pass)| Pass {
                label: match moments.planes {
                    1 => pass.label.clone(),
                    _ => format!("plane {plane}: {}", pass.label),
                },
                plane,
                ..pass.clone()
            })
            .collect();
        Ok(NodeDesc {
            name: "blur".to_owned(),
            stage: Stage::AfterShadowMaps,
            slots: vec![
                slot(
                    "map",
                    Direction::In,
                    Access::READ,
                    FormatRule::OneOf(map_formats()),
                    CountRule::Any,
                ),
                slot(
                    "half_blurred",
                    Direction::Internal,
                    Access::READ.union(drawn_map::write_access(&encoding)),
                    FormatRule::Exact(encoding.format()),
                    CountRule::Exact(1),
                ),
                slot(
                    "blurred",
                    Direction::Out,
                    drawn_map::write_access(&encoding),
                    FormatRule::SameAs("map".to_owned()),
                    CountRule::Exact(mips),
                ),
            ],
            passes,
            parameters: (!unrolled).then(|| ParameterBlock {
                name: "BlurParameters".to_owned(),
                size: size_of::<BlurParameters>() as u32,
                elements: 1,
                each_layer_of: None,
                initial: bytemuck::bytes_of(&BlurParameters::new(&kernel)).to_vec(),
            }),
        })
    }
}

/// One of the two passes.
struct Along {
    label: &'static str,
    /// 0 for x, 1 for y.
    axis: usize,
    /// The unit vector along the axis, in WGSL.
    step: &'static str,
    /// The slots that the pass reads and writes.
    from: &'static str,
    to: &'static str,
}

const ALONG: [Along; 2] = [
    Along {
        label: "blur along x",
        axis: 0,
        step: "vec2i(1, 0)",
        from: "map",
        to: "half_blurred",
    },
    Along {
        label: "blur along y",
        axis: 1,
        step: "vec2i(0, 1)",
        from: "half_blurred",
        to: "blurred",
    },
];

impl Along {
    fn pass(
        &self,
        upstream: &Connected<'_>,
        moments: &TextureDesc,
        encoding: &MapEncoding,
        kernel: &Kernel,
        unrolled: bool,
    ) -> Result<Pass, GraphError> {
        let workgroup = if unrolled && self.axis == 1 {
            WORKGROUP_UNROLLED_Y
        } else {
            WORKGROUP
        };
        let specialization = Specialization::new(upstream.capabilities())
            .constant("WORKGROUP_X", &workgroup[0].to_string())
            .constant("WORKGROUP_Y", &workgroup[1].to_string())
            .constant("AXIS", self.step);
        let specialization = techniques::specialize_map(specialization, encoding);
        let specialization = region_tiles::specialize(specialization, moments);
        let filtering = techniques::filtering(encoding.technique());
        let sums = if encoding.has_split_sums() {
            Sums::Split
        } else {
            Sums::Plain
        };
        let mut bindings = vec![
            Binding {
                binding: 0,
                resource: BindingResource::Layer(self.from.to_owned()),
            },
            // A region holds at least a kernel, so that no texel is repeated at two edges.
            region_tiles::binding(self.to, 2 * kernel.radius() + 1),
        ];
        bindings.extend(drawn_map::binding(encoding, 1, self.to, 0));
        if !unrolled {
            bindings.push(Binding {
                binding: 2,
                resource: BindingResource::Parameters,
            });
        }
        let (wgsl, outputs) = if encoding.storage().is_drawn() {
            let text;
            let texel = if unrolled {
                text = unrolled::literal_texel(kernel.weights());
                &text
            } else {
                DRAWN_TEXEL
            };
            let modules = [
                ("blur_texel", texel),
                PARAMETERS,
                filtering,
                drawn_map::MODULE,
                FULLSCREEN,
            ];
            let wgsl = specialization.link("blur_drawn.wgsl", DRAWN_SHADER, &modules)?;
            (wgsl, 1)
        } else if unrolled {
            let text = unrolled::literal_weights(kernel.weights(), sums);
            (
                specialization.link(
                    "blur_unrolled.wgsl",
                    UNROLLED_SHADER,
                    &[
                        ("blur_target", TARGET),
                        (unrolled::MODULE, &text),
                        filtering,
                        region_tiles::MODULE,
                    ],
                )?,
                unrolled::OUTPUTS_LITERAL,
            )
        } else {
            let text = unrolled::uniform_weights(sums);
            (
                specialization.link(
                    "blur_uniform.wgsl",
                    UNIFORM_SHADER,
                    &[
                        ("blur_target", TARGET),
                        PARAMETERS,
                        (unrolled::MODULE, &text),
                        filtering,
                        region_tiles::MODULE,
                    ],
                )?,
                unrolled::OUTPUTS_UNIFORM,
            )
        };
        let mut texels_per_workgroup = workgroup;
        texels_per_workgroup[self.axis] *= outputs as u32;
        Ok(Pass {
            label: self.label.to_owned(),
            wgsl,
            entry_point: "blur".to_owned(),
            bindings,
            constants: [].into(),
            plane: 0,
            work: drawn_map::work(encoding, self.to, 0, texels_per_workgroup),
        })
    }
}

fn check_fits(kernel: &Kernel, moments: &TextureDesc) -> Result<(), GraphError> {
    let shortest = moments.size[0].min(moments.size[1]);
    if 2 * kernel.radius() < shortest {
        return Ok(());
    }
    let largest = (shortest.saturating_sub(1) / 2).min(LARGEST_RADIUS);
    Err(GraphError::new(
        GraphErrorKind::Size,
        format!(
            "a kernel of radius {} is wider than the map of {}x{} texels; the largest radius for it is {largest}",
            kernel.radius(),
            moments.size[0],
            moments.size[1]
        ),
    )
    .at_slot("map"))
}

fn slot(
    name: &str,
    direction: Direction,
    access: Access,
    format: FormatRule,
    mips: CountRule,
) -> Slot {
    let (extent, layers) = match direction {
        Direction::In => (ExtentRule::Any, CountRule::Any),
        _ => (
            ExtentRule::SameAs("map".to_owned()),
            CountRule::SameAs("map".to_owned()),
        ),
    };
    Slot {
        name: name.to_owned(),
        direction,
        lifetime: Lifetime::Frame,
        optional: false,
        resource: SlotResource::Texture {
            access,
            format,
            extent,
            layers,
            mips,
            samples: CountRule::Exact(1),
        },
    }
}
