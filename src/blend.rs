//! Blending of translucent casters into a map, as data by WebGPU's names.

use serde::{Deserialize, Serialize};

/// How a render pipeline blends into a target: WebGPU's `GPUBlendState`, whose operations are `add`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BlendState {
    /// Of red, green and blue.
    pub color: BlendComponent,
    /// Of the fourth channel.
    pub alpha: BlendComponent,
}

/// The factors of what a fragment writes and of what the target holds. Their products are added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct BlendComponent {
    /// Of what the fragment writes.
    pub src_factor: BlendFactor,
    /// Of what the target holds.
    pub dst_factor: BlendFactor,
}

/// A factor, by WebGPU's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BlendFactor {
    /// 0.
    Zero,
    /// 1.
    One,
    /// 1 less what the fragment writes, channel by channel.
    OneMinusSrc,
    /// The fourth channel of what the fragment writes.
    SrcAlpha,
    /// 1 less that.
    OneMinusSrcAlpha,
    /// The pass's blend constant.
    Constant,
    /// 1 less that.
    OneMinusConstant,
    /// What the fragment writes as its second source, channel by channel.
    Src1,
    /// 1 less that.
    OneMinusSrc1,
}

/// Where blending takes the opacity of a translucent caster from: how much light it keeps from what lies behind it.
///
/// A map of four channels holds four moments, so that its fourth channel is no opacity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Opacity {
    /// The fourth channel of what the fragment writes: for maps that leave it free.
    Alpha,
    /// The blend constant, for draws of one opacity. It has it in all four channels.
    Constant,
    /// What the fragment writes at `@location(0) @blend_src(1)`, in all four channels: for maps of one texture layer, on devices with
    /// WebGPU's feature `dual-source-blending`.
    SecondSource,
    /// Two draws, one after the other, of what does not cover itself: the first writes the opacity in all four channels, the second the
    /// texel times the opacity. Each rounds, so a caster counts twice.
    TwoDraws,
}

impl Opacity {
    /// Every source.
    pub const ALL: [Opacity; 4] = [
        Opacity::Alpha,
        Opacity::Constant,
        Opacity::SecondSource,
        Opacity::TwoDraws,
    ];

    /// How each draw of a caster blends the channels that hold the map.
    pub(crate) fn components(self) -> &'static [BlendComponent] {
        use BlendFactor as F;
        const fn of(src_factor: F, dst_factor: F) -> BlendComponent {
            BlendComponent {
                src_factor,
                dst_factor,
            }
        }
        match self {
            Opacity::Alpha => &[const { of(F::SrcAlpha, F::OneMinusSrcAlpha) }],
            Opacity::Constant => &[const { of(F::Constant, F::OneMinusConstant) }],
            Opacity::SecondSource => &[const { of(F::Src1, F::OneMinusSrc1) }],
            Opacity::TwoDraws => &[
                const { of(F::Zero, F::OneMinusSrc) },
                const { of(F::One, F::One) },
            ],
        }
    }
}

impl BlendComponent {
    /// The target keeps what it holds.
    pub(crate) const KEEP: Self = Self {
        src_factor: BlendFactor::Zero,
        dst_factor: BlendFactor::One,
    };
}
