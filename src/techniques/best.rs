//! Which techniques and storages have the least error in pictures, as measured.

use super::{MapEncoding, Technique};
use crate::Profile;
use crate::Storage::{self, Float16, Float32, Packed32, Packed64, Unorm8, Unorm10, Unorm16};

/// Techniques with usual settings and their storages, the least error first. Recorded in `examples/lab/best.json`; a test holds both.
const RECORDED: [(&str, Storage); 28] = [
    ("hamburger6", Float32),
    ("hamburger4", Packed64),
    ("hamburger4", Float32),
    ("hausdorff4", Float32),
    ("hamburger4", Packed32),
    ("hamburger6", Unorm16),
    ("hausdorff4", Unorm16),
    ("hamburger4", Unorm16),
    ("evsm4", Float16),
    ("evsm4", Float32),
    ("lvsm", Unorm16),
    ("lvsm", Float32),
    ("hamburger6", Float16),
    ("lvsm", Float16),
    ("hausdorff4", Float16),
    ("hamburger4", Float16),
    ("vsm", Float32),
    ("vsm", Unorm16),
    ("hamburger6", Unorm10),
    ("vsm", Float16),
    ("evsm2", Float16),
    ("esm", Float16),
    ("convolution", Float16),
    ("convolution", Unorm16),
    ("convolution", Unorm8),
    ("evsm2", Float32),
    ("esm", Float32),
    ("esm", Unorm16),
];

impl Technique {
    /// The encoding with the least error in pictures among those whose map has at most `bits` bits per texel, all planes, and that every
    /// device of the profile can write.
    ///
    /// The order is that of `moment-shadows-lab best`: the mean over procedural scenes, views and filters, on a software adapter. It is
    /// of scenes of many fine casters and contacts; `moment-shadows-lab choose` measures yours. `None` where no map has so few bits.
    /// One that is [written once](Storage::is_written_once) is made by a blur that resolves alone; [`by_error`](Self::by_error) has others.
    #[must_use]
    pub fn best(profile: Profile, bits: u32) -> Option<MapEncoding> {
        Self::by_error(profile, bits).next()
    }

    /// All that [`best`](Self::best) chooses among, the least error first: for a map with mip levels the first one that is
    /// [averaged by samplers](MapEncoding::averaged_by_samplers).
    pub fn by_error(profile: Profile, bits: u32) -> impl Iterator<Item = MapEncoding> {
        let all = Self::examples();
        RECORDED.into_iter().filter_map(move |(name, storage)| {
            let technique = all.iter().find(|technique| technique.name() == name)?;
            let encoding = MapEncoding::new(technique.clone(), storage).ok()?;
            let is_offered = encoding.bits_per_texel() <= bits && encoding.check(profile).is_ok();
            is_offered.then_some(encoding)
        })
    }
}
