//! Builtin functions by the names that WGSL has for what naga makes of them.

use naga::{Barrier, Expression, GatherMode, Handle, SampleLevel};

pub(super) fn barrier_name(barrier: Barrier) -> &'static str {
    if barrier.contains(Barrier::STORAGE) {
        "storageBarrier"
    } else if barrier.contains(Barrier::TEXTURE) {
        "textureBarrier"
    } else if barrier.contains(Barrier::SUB_GROUP) {
        "subgroupBarrier"
    } else {
        "workgroupBarrier"
    }
}

pub(super) fn sample_name(sample: &Expression) -> &'static str {
    match sample {
        Expression::ImageSample {
            depth_ref: Some(_), ..
        } => "textureSampleCompare",
        Expression::ImageSample {
            level: SampleLevel::Bias(_),
            ..
        } => "textureSampleBias",
        _ => "textureSample",
    }
}

pub(super) fn derivative_name(
    axis: naga::DerivativeAxis,
    control: naga::DerivativeControl,
) -> &'static str {
    use naga::DerivativeAxis::{Width, X, Y};
    use naga::DerivativeControl::{Coarse, Fine, None};
    match (axis, control) {
        (X, None) => "dpdx",
        (X, Fine) => "dpdxFine",
        (X, Coarse) => "dpdxCoarse",
        (Y, None) => "dpdy",
        (Y, Fine) => "dpdyFine",
        (Y, Coarse) => "dpdyCoarse",
        (Width, None) => "fwidth",
        (Width, Fine) => "fwidthFine",
        (Width, Coarse) => "fwidthCoarse",
    }
}

/// The function of a mode, and the argument that has to be uniform.
pub(super) fn gather_name(mode: GatherMode) -> (&'static str, Option<Handle<Expression>>) {
    match mode {
        GatherMode::BroadcastFirst => ("subgroupBroadcastFirst", None),
        GatherMode::Broadcast(_) => ("subgroupBroadcast", None),
        GatherMode::Shuffle(_) => ("subgroupShuffle", None),
        GatherMode::ShuffleDown(by) => ("subgroupShuffleDown", Some(by)),
        GatherMode::ShuffleUp(by) => ("subgroupShuffleUp", Some(by)),
        GatherMode::ShuffleXor(by) => ("subgroupShuffleXor", Some(by)),
        GatherMode::QuadBroadcast(_) => ("quadBroadcast", None),
        GatherMode::QuadSwap(_) => ("quadSwap", None),
    }
}
