//! Filters a map of moments with a separable kernel.

mod unrolled;

use bytemuck::{Pod, Zeroable};
use moment_shadows::{Finite, Kernel, MapEncoding};
use serde::{Deserialize, Serialize};

use super::shared::{KernelProperty, MipLevels, Specialization, map_input, regions, wgsl};
use super::techniques;
use crate::{
    Connected, GraphError, GraphErrorKind, Node, NodeDesc, ParameterBlock, Pass, Rule, Stage,
    TextureDesc, TextureRule, bind,
};

/// Outputs per invocation where weights are literals.
const OUTPUTS_LITERAL: u32 = 8;

/// Outputs per invocation where weights are uniform.
const OUTPUTS_UNIFORM: u32 = 16;

/// Up to this radius the weights are literals and every load is unrolled; beyond it the code would leave the instruction
/// cache.
const LARGEST_UNROLLED_RADIUS: u32 = 12;

/// Invocations of a workgroup in x and y.
const WORKGROUP: [u32; 2] = [8, 8];

/// Along y with few taps: the invocations of a workgroup load one row at a time, in whole cache lines. With many taps the
/// texels that lie above each other are worth more, and a square has more of them.
const WORKGROUP_UNROLLED_Y: [u32; 2] = [64, 1];

/// Node `blur`: `map` to `blurred`, of the same format, size, layers and regions. Two passes, along x and along
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
    4 * (Kernel::LARGEST_RADIUS as usize * 2 + OUTPUTS_UNIFORM as usize).div_ceil(16) + 4;

impl BlurParameters {
    /// The parameters that stand for a kernel.
    #[must_use]
    pub fn new(kernel: &Kernel) -> Self {
        let mut flat = [0.0; BLUR_WEIGHT_VECTORS * 4];
        let before = OUTPUTS_UNIFORM as usize - 1;
        for (slot, &weight) in flat[before..].iter_mut().zip(kernel.weights()) {
            *slot = weight;
        }
        let taps = 2 * kernel.radius() + OUTPUTS_UNIFORM;
        Self {
            radius: kernel.radius(),
            blocks: taps.div_ceil(16),
            padding: [0; 2],
            weights: bytemuck::cast(flat),
        }
    }
}

impl Node for Blur {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (map, encoding) = map_input::connected(upstream, "map")?;
        let kernel = self.kernel.kernel()?;
        check_fits(&kernel, map)?;
        let mips = self.mip_levels.count(map.size)?;
        let deviation = Finite::new(kernel.standard_deviation()).map_err(techniques::property)?;
        let unrolled = !self.per_frame && kernel.radius() <= LARGEST_UNROLLED_RADIUS;
        let along = ALONG
            .iter()
            .map(|along| along.pass(upstream, map, &encoding, &kernel, unrolled))
            .collect::<Result<Vec<_>, _>>()?;
        // The planes take turns with one intermediate map.
        let passes = (0..map.planes)
            .flat_map(|plane| along.iter().map(move |pass| (plane, pass)))
            .map(|(plane, pass)| Pass {
                label: match map.planes {
                    1 => pass.label.clone(),
                    _ => format!("plane {plane}: {}", pass.label),
                },
                plane,
                ..pass.clone()
            });
        let desc = NodeDesc::new("blur", Stage::AfterShadowMaps)
            .input(
                "map",
                "The map to filter.",
                map_input::rule(&map_input::FORMATS),
            )
            .internal(
                "half_blurred",
                "A plane of the map, filtered along x.",
                TextureRule::new(encoding.format()).like("map"),
            )
            .output(
                "blurred",
                "The map, filtered along x and y.",
                TextureRule::new(Rule::same_as("map"))
                    .like("map")
                    .mips(mips)
                    .filtered(deviation),
            )
            .passes(passes);
        if unrolled {
            return Ok(desc);
        }
        let block = ParameterBlock::of::<BlurParameters>("BlurParameters");
        Ok(desc.parameters(block.initial(&BlurParameters::new(&kernel))))
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
        let text;
        let (shader, body, outputs) = match (encoding.storage().is_drawn(), unrolled) {
            (true, true) => {
                text = unrolled::texel(kernel.weights());
                (
                    wgsl!("blur_drawn.wgsl"),
                    Some(("blur_texel", text.as_str())),
                    1,
                )
            }
            (true, false) => {
                let uniform = include_str!("blur_texel_uniform.wgsl");
                (wgsl!("blur_drawn.wgsl"), Some(("blur_texel", uniform)), 1)
            }
            (false, true) => {
                text = unrolled::block(kernel.weights());
                let body = Some((unrolled::MODULE, text.as_str()));
                (wgsl!("blur_unrolled.wgsl"), body, OUTPUTS_LITERAL)
            }
            (false, false) => (wgsl!("blur_uniform.wgsl"), None, OUTPUTS_UNIFORM),
        };
        let specialization = Specialization::new(upstream.capabilities())
            .constant("WORKGROUP_X", &workgroup[0].to_string())
            .constant("WORKGROUP_Y", &workgroup[1].to_string())
            .constant("AXIS", self.step)
            .constant("OUTPUTS", &outputs.to_string())
            .constant("SPLIT_SUMS", &encoding.has_split_sums().to_string());
        let specialization = techniques::specialize_map(specialization, encoding);
        let specialization = regions::specialize(specialization, moments);
        let mut modules = vec![
            ("blur_source", include_str!("blur_source.wgsl")),
            ("blur_target", include_str!("blur_target.wgsl")),
            ("blur_parameters", include_str!("blur_parameters.wgsl")),
        ];
        modules.extend(body);
        modules.extend(regions::modules(encoding));
        let wgsl = specialization.link(shader, &modules)?;
        let mut texels_per_workgroup = workgroup;
        texels_per_workgroup[self.axis] *= outputs;
        // A region holds at least a kernel, so that no texel is repeated at two edges.
        let smallest = 2 * kernel.radius() + 1;
        let target = (self.to, 0);
        let pass = regions::write(
            self.label,
            encoding,
            target,
            "blurred_map",
            texels_per_workgroup,
            smallest,
        )
        .shader(wgsl, "blur")
        .bind("moments_map", bind::layer(self.from));
        Ok(if unrolled {
            pass
        } else {
            pass.bind("parameters", bind::parameters())
        })
    }
}

fn check_fits(kernel: &Kernel, moments: &TextureDesc) -> Result<(), GraphError> {
    let shortest = moments.size[0].min(moments.size[1]);
    if 2 * kernel.radius() < shortest {
        return Ok(());
    }
    let largest = (shortest.saturating_sub(1) / 2).min(Kernel::LARGEST_RADIUS);
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
