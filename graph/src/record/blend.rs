//! Blend states in wgpu's terms.

use moment_shadows::{BlendComponent, BlendFactor, BlendState};

/// A blend state in wgpu's terms.
#[must_use]
pub fn blend_state(state: &BlendState) -> wgpu::BlendState {
    wgpu::BlendState {
        color: component(state.color),
        alpha: component(state.alpha),
    }
}

fn component(of: BlendComponent) -> wgpu::BlendComponent {
    wgpu::BlendComponent {
        src_factor: factor(of.src_factor),
        dst_factor: factor(of.dst_factor),
        operation: wgpu::BlendOperation::Add,
    }
}

fn factor(of: BlendFactor) -> wgpu::BlendFactor {
    match of {
        BlendFactor::Zero => wgpu::BlendFactor::Zero,
        BlendFactor::One => wgpu::BlendFactor::One,
        BlendFactor::OneMinusSrc => wgpu::BlendFactor::OneMinusSrc,
        BlendFactor::SrcAlpha => wgpu::BlendFactor::SrcAlpha,
        BlendFactor::OneMinusSrcAlpha => wgpu::BlendFactor::OneMinusSrcAlpha,
        BlendFactor::Constant => wgpu::BlendFactor::Constant,
        BlendFactor::OneMinusConstant => wgpu::BlendFactor::OneMinusConstant,
        BlendFactor::Src1 => wgpu::BlendFactor::Src1,
        BlendFactor::OneMinusSrc1 => wgpu::BlendFactor::OneMinusSrc1,
    }
}
