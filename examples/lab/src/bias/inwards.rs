//! Texels of four moments that are rounded inwards, as the WGSL module `inward_rounding` does it, in f64.

use moment_shadows::Storage;

use super::form::{Form, rounded};

/// The share of the bias by which moments are moved where no texel around is valid.
const MOVE: f64 = 3.7;

/// The share of the bias with which texels are valid.
const SHARE: f64 = 1.0 / 3.0;

/// The moments of the texel for these; none for a form without a basis.
pub(super) fn rounded_inwards<const M: usize>(
    form: &Form<M>,
    alpha: f64,
    b: &[f64; M],
) -> Option<[f64; M]> {
    let basis = form.basis.as_ref()?;
    let around = basis.encode(b).map(|channel| around(form.storage, channel));
    let texels = (0..1_u32 << M).map(|number| {
        let channels = core::array::from_fn(|index| around[index][(number >> index & 1) as usize]);
        basis.decode(&channels)
    });
    let valid = texels.filter_map(|moments| {
        let [b1, b2, b3, b4] = form.biased(&moments, SHARE * alpha)[..] else {
            return None;
        };
        let (variance, covariance) = (b2 - b1 * b1, b3 - b1 * b2);
        let determinant = variance * (b4 - b2 * b2) - covariance * covariance;
        (variance > 0.0 && determinant > 0.0).then_some((determinant, moments))
    });
    let best = valid.min_by(|one, other| one.0.total_cmp(&other.0));
    let moved = || {
        let channels = basis.encode(&form.biased(b, MOVE * alpha));
        basis.decode(&channels.map(|channel| f64::from(rounded(form.storage, channel as f32))))
    };
    Some(best.map_or_else(moved, |(_, moments)| moments))
}

/// The channels of a storage on both sides of a value.
fn around(storage: Storage, value: f64) -> [f64; 2] {
    if storage == Storage::Unorm16 {
        let code = (value.clamp(0.0, 1.0) * 65535.0).floor();
        return [code, (code + 1.0).min(65535.0)].map(|code| code / 65535.0);
    }
    let value = value.clamp(-0.5, 0.5);
    let spacing = 2_f64.powf(value.abs().max(2_f64.powi(-14)).log2().floor() - 10.0);
    let low = (value / spacing).floor() * spacing;
    [low, (low + spacing).min(0.5)]
}
