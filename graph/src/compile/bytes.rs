//! How many bytes a pass moves.

use crate::plan::Part;
use crate::{PlannedPass, PlannedResource, PlannedWork};

/// Counts every texel that a pass binds once, however often the shader loads it: what has to cross the memory bus.
pub(super) fn count(pass: &mut PlannedPass, resources: &[PlannedResource]) {
    let layers = u64::from(pass.layers);
    let level = |resource: usize, level: u32| {
        let texture = resources[resource].desc.texture();
        texture.map_or(0, |it| it.bytes_per_level(level).saturating_mul(layers))
    };
    let uniforms = pass.bindings.iter();
    let uniforms = uniforms.filter_map(|binding| binding.uniform_size());
    let mut read: u64 = uniforms.map(|size| u64::from(size) * layers).sum();
    let mut written = 0;
    for touch in pass.touches() {
        let bytes = match touch.part {
            Part::Level { level: of, .. } => level(touch.resource, of),
            Part::Buffer | Part::Layers => resources[touch.resource].desc.bytes(),
        };
        if touch.access.read {
            read = read.saturating_add(bytes);
        }
        if touch.access.writes() {
            written = bytes.saturating_add(written);
        }
    }
    if let PlannedWork::Host {
        targets,
        planes,
        blend: true,
        ..
    } = &pass.work
    {
        let targets = targets.iter().map(|&target| level(target, 0));
        let blended = targets.fold(0, u64::saturating_add);
        read = read.saturating_add(blended.saturating_mul(u64::from(*planes)));
    }
    (pass.bytes_read, pass.bytes_written) = (read, written);
}
