//! Six moments with 10 bits each, as they were published, to compare with.

use moment_shadows::Storage;
use moment_shadows_graph::nodes::CompositeScattering;
use moment_shadows_graph::{Connected, GraphError, GraphErrorKind, Node, NodeDesc};
use serde::Deserialize;

/// Node `composite_ten_bits`: [`CompositeScattering`] of a unorm16 map of six moments, each looked up with 10 bits: the moments of whole
/// view rays, without the weights that our maps keep in the fourth channels (Peters, GDC 2016). Compute shaders cannot write
/// rgb10a2unorm, so what is rounded is what was looked up.
#[derive(Clone, Debug, Deserialize)]
#[serde(transparent)]
pub(super) struct CompositeTenBits(CompositeScattering);

/// What becomes of both texels.
const BOUNDS: &str = "return enclosed_moments_bounds(array<vec4f, 2>(odd, even), depth, STORAGE);";

/// What takes its place. An occluder at the near end has odd channels of 0, one at the far end of 1; even ones are the same at both.
const ROUNDED: &str = "let ends = (1.0 - even.w) * vec3f(0.0, 1.0, 0.98111829);
    let whole_odd = round(1023.0 * (odd.xyz + odd.w - even.w)) / 1023.0;
    let whole_even = round(1023.0 * (even.xyz + ends)) / 1023.0;
    let bias = SixMomentsBias(vec3f(EVEN), ALPHA);
    let biased = six_moments_apply_bias(six_moments_from_channels(whole_odd, whole_even, 0.0), bias);
    return hamburger6_bounds_at(hamburger6_factor(biased, bias.alpha), depth - biased.odd.x, bias.alpha);";

impl Node for CompositeTenBits {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let refused = || {
            let reason = "only maps of six moments are rounded to 10 bits";
            GraphError::new(GraphErrorKind::Format, reason).at_slot("integrated")
        };
        let bias = Storage::Unorm10.six_moments_bias().ok_or_else(refused)?;
        let even = bias.even.map(|it| format!("{it:?}")).join(", ");
        let rounded = ROUNDED.replace("EVEN", &even);
        let rounded = rounded.replace("ALPHA", &format!("{:?}", bias.alpha));
        let mut desc = self.0.describe(upstream)?;
        for pass in &mut desc.passes {
            if !pass.wgsl.contains(BOUNDS) {
                return Err(refused());
            }
            pass.wgsl = pass.wgsl.replace(BOUNDS, &rounded);
        }
        Ok(desc)
    }
}
