//! One input of the report: surfaces, how they are filtered, and a fragment.

use bytemuck::{Pod, Zeroable};
use moment_shadows::DepthConversion;
use serde::{Deserialize, Serialize};

/// Surfaces that a filter sees and a fragment, as the shader reads them (WGSL's layout of a storage buffer).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable, Serialize, Deserialize)]
#[serde(try_from = "Vec<u32>", into = "Vec<u32>")]
pub struct Input {
    /// Depths of up to eight surfaces: moment depths in [-1, 1], or as a map stores them where `converted` is 1.
    pub depths: [f32; 8],
    /// Their weights in a mixture, summing to 1; or the texel itself in the first four.
    pub weights: [f32; 8],
    /// How stored depth becomes moment depth.
    pub conversion: DepthConversion,
    /// Depth of the fragment, in the unit of `depths`.
    pub fragment_depth: f32,
    /// [`MIXTURE`](Self::MIXTURE), [`PATCH`](Self::PATCH) or [`TEXEL`](Self::TEXEL).
    pub kind: u32,
    /// 1 where depths are as a map stores them.
    pub converted: u32,
    /// Surfaces of a patch, 1 to 8.
    pub count: u32,
    /// Index of a patch's kernel in [`kernels`](super::kernels::kernels).
    pub kernel: u32,
    /// How many of the four samples of a patch's texel see the next surface instead, 0 to 3.
    pub coverage: u32,
    /// A patch has two kinds of rows. The seeds of the patterns of their texels.
    pub rows: [u32; 2],
    /// The seed of the pattern of rows.
    pub column: u32,
    /// Neighbours in a row that are alike, at least 1.
    pub row_run: u32,
    /// Neighbouring rows that are alike, at least 1.
    pub column_run: u32,
    /// Unused; keeps the WGSL layout.
    pub padding: u32,
}

impl Input {
    /// All surfaces averaged with `weights` and rounded once.
    pub const MIXTURE: u32 = 0;
    /// Texels that each see one or two surfaces, rounded, filtered along rows, rounded, filtered along columns, rounded.
    pub const PATCH: u32 = 1;
    /// A texel that no encoding need have made.
    pub const TEXEL: u32 = 2;
}

/// As words: JSON has no numbers that are not finite, and inputs have.
impl From<Input> for Vec<u32> {
    fn from(input: Input) -> Self {
        bytemuck::cast_slice(&[input]).to_vec()
    }
}

impl TryFrom<Vec<u32>> for Input {
    type Error = String;

    fn try_from(words: Vec<u32>) -> Result<Self, String> {
        bytemuck::try_pod_read_unaligned(bytemuck::cast_slice(&words))
            .map_err(|_| format!("{} words are no input", words.len()))
    }
}

impl Default for Input {
    /// A mixture without weights at moment depth 0.
    fn default() -> Self {
        Self {
            depths: [0.0; 8],
            weights: [0.0; 8],
            conversion: DepthConversion::orthographic(),
            fragment_depth: 0.0,
            kind: Self::MIXTURE,
            converted: 0,
            count: 1,
            kernel: 0,
            coverage: 0,
            rows: [0; 2],
            column: 0,
            row_run: 1,
            column_run: 1,
            padding: 0,
        }
    }
}
