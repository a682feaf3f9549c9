//! Filters a map of moments with a separable kernel.

mod kernel;
mod source;
mod unrolled;

pub use kernel::BlurKernel;
use moment_shadows::{Finite, Kernel, ValueError};
use serde::Deserialize;

use source::Source;

use super::shared::{mip_levels, regions, wgsl, wrong_property, wrong_size};
use super::{Resolve, techniques};
use crate::{
    Connected, GraphError, Node, NodeDesc, ParameterBlock, Pass, Slot, Stage, TextureDesc,
    TextureRule, bind,
};

/// Outputs per invocation where weights are literals.
const OUTPUTS_LITERAL: u32 = 8;

/// Outputs per invocation along x where a depth map is resolved: each texel that is encoded serves many, but code has to stay in an
/// instruction cache, and registers few. On navi21 (`moment-shadows-lab isa`, inwards, radius 4, then 12) 8, 16 and 32 keep its arithmetic busy for 306, 258
/// and 234 cycles (558, 416, 345), with 64, 88 and 96 registers (64, 104, 168) in 13, 21 and 38 KB of code (23, 33, 54). Along y, where 8, 16
/// and 32 take 269, 257 and 252 (380, 344, 327) in 15, 28 and 55 KB, they are those of literals.
const OUTPUTS_RESOLVED: u32 = 16;

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
/// compute shaders. With `resolve` it takes a depth map in place of `map`, with the inputs and parameters of [`Resolve`], and the pass along x
/// resolves it: one pass and one rounding less than both nodes.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Blur {
    /// The kernel, the same along both axes; the node refuses what is none. In a file a `radius` and a `sigma` in texels (0.6
    /// of the radius where it is left out), or `weights`; or the largest `radius` and a `width` in scene units, for a kernel of each
    /// region's own.
    #[serde(deserialize_with = "kernel::read")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "kernel::schema"))]
    pub kernel: Result<BlurKernel, ValueError>,
    /// Whether the kernel can change per frame: its weights are then a node parameter ([`Blur::parameters`]), which begins
    /// as `kernel`. Kernels of a radius above 12 have the parameter in any case, as have those of a `width`: two for each region,
    /// along x and along y ([`Kernel::of_width`]), which begin as the widest. `Session` writes them.
    #[serde(default)]
    pub per_frame: bool,
    /// What the node [`Resolve`] would be told that comes before, in its place: `technique`, `storage` and `bits`. Its `blends` and
    /// `mip_levels` are refused, since translucent casters are blended in between, and this node's own `mip_levels` count; as are maps that
    /// are drawn, and kernels whose weights are parameters.
    #[serde(default)]
    pub resolve: Option<Resolve>,
    /// With `resolve`, for `hamburger4` as `unorm16` or `float16`: whether the map is filtered without rounding in between (as packed texels, in as
    /// many bits), and its texels are rounded inwards, to valid moments, so that the bias is a quarter or less. Nodes that read it know. It
    /// takes nearly three times the arithmetic, and leaves no room for mip levels, whose texels are averages that are rounded again.
    #[serde(default)]
    pub rounded_inwards: bool,
    /// Room for mip levels, which [`super::Downsample`] fills: a number, the map itself included, or `None` (in a file `"all"`)
    /// for as many as the shorter side of the map allows.
    #[serde(default = "mip_levels::one", deserialize_with = "mip_levels::read")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "mip_levels::schema"))]
    pub mip_levels: Option<u32>,
}

impl Blur {
    /// Words of the struct `BlurParameters` in WGSL: four, then the weights in 16-tap blocks of the largest kernel, and one more
    /// block that the last outputs reach into.
    pub const PARAMETER_WORDS: usize =
        4 + 16 * (Kernel::LARGEST_RADIUS as usize * 2 + OUTPUTS_UNIFORM as usize).div_ceil(16) + 16;

    /// The parameters that stand for a kernel: its radius, the blocks of 16 taps that the shader runs through, two zeros (the first of
    /// which is, in what a plan begins with, the width in scene units), and as bits of f32 the weights, preceded by 15 zeros and
    /// followed by zeros.
    #[must_use]
    pub fn parameters(kernel: &Kernel) -> [u32; Self::PARAMETER_WORDS] {
        let mut words = [0; Self::PARAMETER_WORDS];
        words[0] = kernel.radius();
        words[1] = (2 * kernel.radius() + OUTPUTS_UNIFORM).div_ceil(16);
        let weights = words[4..].iter_mut().skip(OUTPUTS_UNIFORM as usize - 1);
        for (word, weight) in weights.zip(kernel.weights()) {
            *word = weight.to_bits();
        }
        words
    }
}

impl Node for Blur {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let kernel = self.kernel.as_ref().map_err(wrong_property)?;
        let (kernel, width) = match kernel {
            BlurKernel::Texels(kernel) => (kernel.clone(), None),
            BlurKernel::Scene { width, radius } => {
                let positive = width.get() > 0.0;
                if !positive {
                    return Err(wrong_property(format!(
                        "the kernel's 'width' is {width}; it is a positive length in scene units"
                    )));
                }
                let widest = Kernel::gaussian(*radius, *radius as f32).map_err(wrong_property)?;
                (widest, Some(*width))
            }
        };
        let kernel = &kernel;
        let is_literal =
            !self.per_frame && width.is_none() && kernel.radius() <= LARGEST_UNROLLED_RADIUS;
        let source = match &self.resolve {
            None if self.rounded_inwards => {
                return Err(wrong_property(
                    "'rounded_inwards' is for a blur with 'resolve': a map that is connected was rounded to all sides before; give this node \
                     'resolve' in place of the node before it, or leave 'rounded_inwards' out",
                ));
            }
            None => Source::map(upstream)?,
            Some(_) if self.rounded_inwards && self.mip_levels != Some(1) => {
                return Err(wrong_property(
                    "'rounded_inwards' leaves no room for 'mip_levels', whose texels are averages that are rounded to all sides; leave one of \
                     them out",
                ));
            }
            Some(resolve) => Source::resolved(resolve, upstream, is_literal, self.rounded_inwards)?,
        };
        let (map, encoding) = (source.desc, &source.encoding);
        check_fits(kernel, map).map_err(|error| error.at_slot(source.slot))?;
        let deviation = match width {
            None => Finite::new(kernel.standard_deviation()).map_err(wrong_property)?,
            Some(_) => Finite::ZERO,
        };
        let mips = mip_levels::count(self.mip_levels, map.size)?;
        let kernels = width.map_or(1, |_| 2 * map.regions);
        let along = |axis| pass(axis, upstream, &source, (kernel, kernels), is_literal);
        // Each plane has an intermediate map of its own, so that no pass overwrites what another still has to read, whatever
        // the order. In the plan's order all of them share memory.
        let planes = encoding.planes();
        let names = (0..planes).map(|plane| half_blurred(plane, planes));
        let halves = names.map(|name| {
            let half = TextureRule::new(source.half.format()).like(source.slot);
            Slot::internal(&name, "A plane, filtered along x.", half)
        });
        let passes = regions::of_each_plane(planes, vec![along(0)?, along(1)?]);
        let passes = passes.map(|pass| {
            let name = half_blurred(pass.plane, planes);
            source.of_plane(pass.with_slot(HALF_BLURRED, &name))
        });
        let blurred = source
            .made
            .clone()
            .mips(mips)
            .filtered(deviation)
            .filtered_in_scene(width.unwrap_or_default());
        let desc = NodeDesc::new("blur", Stage::AfterShadowMaps)
            .slots(source.inputs.clone())
            .slots(halves)
            .output("blurred", "The map, filtered along x and y.", blurred)
            .passes(passes);
        let desc = match source.off(mips) {
            Some(off) => desc.off("blurred", off),
            None => desc,
        };
        if is_literal {
            return Ok(match source.conversions() {
                Some(block) => desc.parameters(block),
                None => desc,
            });
        }
        let mut initial = Self::parameters(kernel);
        initial[2] = width.unwrap_or_default().get().to_bits();
        let block = ParameterBlock::of::<[u32; Self::PARAMETER_WORDS]>("BlurParameters");
        let block = block.elements(kernels).initial(&initial);
        Ok(desc.parameters(match width {
            None => block,
            Some(_) => block.each_layer_of("map"),
        }))
    }
}

/// The slot between the passes of a plane, in a map of one plane.
const HALF_BLURRED: &str = "half_blurred";

/// The slot between the passes of a plane.
fn half_blurred(plane: u32, planes: u32) -> String {
    match planes {
        1 => HALF_BLURRED.to_owned(),
        _ => format!("{HALF_BLURRED}_{plane}"),
    }
}

/// The pass along x (0) or y (1).
fn pass(
    axis: usize,
    upstream: &Connected<'_>,
    source: &Source<'_>,
    (kernel, kernels): (&Kernel, u32),
    is_literal: bool,
) -> Result<Pass, GraphError> {
    let (label, step, from, to) = [
        ("blur along x", "vec2i(1, 0)", source.slot, HALF_BLURRED),
        ("blur along y", "vec2i(0, 1)", HALF_BLURRED, "blurred"),
    ][axis];
    let encoding = [&source.half, &source.encoding][axis];
    let resolved = source.depth().filter(|_| axis == 0);
    let label = resolved.map_or(label, |_| "resolve and blur along x");
    let workgroup = if is_literal && axis == 1 {
        WORKGROUP_UNROLLED_Y
    } else {
        WORKGROUP
    };
    let weights = kernel.weights();
    let (outputs, many, one) = if is_literal {
        let outputs = resolved.map_or(OUTPUTS_LITERAL, |_| OUTPUTS_RESOLVED);
        let many = unrolled::outputs(weights, outputs / 8);
        (outputs, many, unrolled::texel(weights))
    } else {
        let many = include_str!("blur_outputs_uniform.wgsl").to_owned();
        let one = include_str!("blur_texel_uniform.wgsl").to_owned();
        (OUTPUTS_UNIFORM, many, one)
    };
    let shader = if encoding.storage().is_drawn() {
        regions::shader(encoding)
    } else {
        wgsl!("blur.wgsl")
    };
    let (specialization, blur_source) = match resolved {
        Some(resolved) => (
            resolved.specialization.clone(),
            include_str!("blur_source_resolved.wgsl"),
        ),
        None => (
            techniques::of_map(upstream.capabilities(), encoding)
                .unsigned("REGIONS", source.desc.regions)
                .constant("ROUNDED_INWARDS", encoding.is_rounded_inwards()),
            if source.repacks() {
                include_str!("blur_source_packed.wgsl")
            } else {
                include_str!("blur_source.wgsl")
            },
        ),
    };
    let wgsl = specialization
        .unsigned("KERNELS", kernels)
        .unsigned("WORKGROUP_X", workgroup[0])
        .unsigned("WORKGROUP_Y", workgroup[1])
        .constant("AXIS", step)
        .constant("OUTPUTS", outputs)
        .constant("SPLIT_SUMS", encoding.has_split_sums(kernel.radius()))
        .module("blur_source", blur_source)
        .module("blur_target", include_str!("blur_target.wgsl"))
        .module("blur_outputs", many)
        .module("blur_texel", one)
        .module("written_texel", include_str!("blur_drawn.wgsl"))
        .link(shader)?;
    let mut texels = workgroup;
    texels[axis] *= outputs;
    // A region holds at least a kernel, so that no texel is repeated at two edges.
    let smallest = 2 * kernel.radius() + 1;
    let mut pass = regions::write(label, &wgsl, encoding, (to, 0), texels, smallest);
    match resolved {
        Some(resolved) => pass.bindings.extend(resolved.bindings()),
        None => pass = pass.bind("moments_map", bind::layer(from)),
    }
    Ok(if is_literal {
        pass
    } else {
        pass.bind("parameters", bind::parameters())
    })
}

fn check_fits(kernel: &Kernel, map: &TextureDesc) -> Result<(), GraphError> {
    let [width, height] = map.size;
    let shortest = width.min(height);
    if 2 * kernel.radius() < shortest {
        return Ok(());
    }
    let largest = (shortest.saturating_sub(1) / 2).min(Kernel::LARGEST_RADIUS);
    let message = format!(
        "a kernel of radius {} is wider than the map of {width}x{height} texels; the largest radius for it is {largest}",
        kernel.radius()
    );
    Err(wrong_size(message))
}
