//! A model of a compute unit of RDNA 2: how long 64 invocations keep its arithmetic, texture and LDS units busy.
//!
//! Latency, occupancy, caches and memory are left out: the largest of the three numbers is a lower bound of the time.

use super::class::Class;
use super::text::Instruction;

/// Cycles of the three units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cycles {
    /// Vector arithmetic.
    pub alu: f64,
    /// Addressing and filtering of textures.
    pub texture: f64,
    /// Workgroup memory.
    pub lds: f64,
}

/// Two SIMDs of 32 lanes issue one instruction per cycle each.
const VALU: f64 = 1.0;

/// Reciprocals, roots, logarithms, exponentials and 32-bit integer products run at a quarter of the rate.
const QUARTER_RATE: f64 = 4.0;

/// Double precision runs at a sixteenth of the rate.
const DOUBLE_RATE: f64 = 16.0;

/// The texture unit takes four addresses per cycle, and filters four texels of up to 8 bytes bilinearly. Trilinear and
/// anisotropic filtering take longer, depending on the place.
const TEXTURE: f64 = 16.0;

/// Texels of 16 bytes take twice as long if more than two of their channels are asked for.
const WIDE_TEXTURE: f64 = 32.0;

/// The LDS gives 32 banks of 4 bytes per cycle: two cycles for 4 bytes of 64 lanes, without conflicts.
const LDS_PER_DWORD: f64 = 2.0;

/// Beginnings of the mnemonics that run at a quarter of the rate.
const QUARTER_RATE_NAMES: [&str; 9] = [
    "v_rcp_",
    "v_rsq_",
    "v_sqrt_",
    "v_log_",
    "v_exp_",
    "v_sin_",
    "v_cos_",
    "v_mul_lo_u32",
    "v_mul_hi_",
];

/// What one instruction takes, in a shader whose widest texel has `texel_bytes`.
#[must_use]
pub fn of(instruction: &Instruction, texel_bytes: u32) -> Cycles {
    let mut cycles = Cycles::default();
    let name = instruction.mnemonic.as_str();
    match instruction.class {
        Class::Valu => cycles.alu = valu(name),
        Class::Texture => cycles.texture = texture(instruction, texel_bytes),
        // Vector loads and stores of buffers take the texture unit's way.
        Class::Store if name.starts_with("image_") => {
            cycles.texture = texture(instruction, texel_bytes);
        }
        Class::Store if !name.starts_with("exp") => cycles.texture = TEXTURE,
        Class::Memory if !name.starts_with("s_") => cycles.texture = TEXTURE,
        Class::Lds => cycles.lds = LDS_PER_DWORD * lds_dwords(name),
        _ => {}
    }
    cycles
}

fn valu(name: &str) -> f64 {
    if name.contains("_f64") {
        DOUBLE_RATE
    } else if QUARTER_RATE_NAMES.iter().any(|slow| name.starts_with(slow)) {
        QUARTER_RATE
    } else {
        VALU
    }
}

fn texture(instruction: &Instruction, texel_bytes: u32) -> f64 {
    let channels = instruction
        .operands
        .split_once("dmask:0x")
        .and_then(|(_, mask)| mask.chars().next())
        .and_then(|digit| digit.to_digit(16))
        .map_or(4, u32::count_ones);
    // A gather asks for one channel of four texels, whatever the mask.
    let gathers = instruction.mnemonic.starts_with("image_gather4");
    if texel_bytes > 8 && channels > 2 && !gathers {
        WIDE_TEXTURE
    } else {
        TEXTURE
    }
}

/// Dwords that an instruction moves per lane.
fn lds_dwords(name: &str) -> f64 {
    let pair = if name.contains("2_") || name.contains("2st64_") {
        2.0
    } else {
        1.0
    };
    let width = match name.rsplit('_').next() {
        Some("b128") => 4.0,
        Some("b96") => 3.0,
        Some("b64" | "u64" | "i64" | "f64") => 2.0,
        _ => 1.0,
    };
    pair * width
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::isa::text::parse;

    /// Cycles of a line of code.
    fn cycles(line: &str, texel_bytes: u32) -> [f64; 3] {
        let code = parse(line).unwrap_or_default();
        let cycles = of(&code.instructions[0], texel_bytes);
        [cycles.alu, cycles.texture, cycles.lds]
    }

    #[test]
    fn each_unit_has_its_rate() {
        assert_eq!(cycles("v_fma_f32 v0, v1, v2, v3", 8), [1.0, 0.0, 0.0]);
        assert_eq!(cycles("v_rcp_f32_e32 v0, v1", 8), [4.0, 0.0, 0.0]);
        assert_eq!(
            cycles("v_fma_f64 v[0:1], v[2:3], v[4:5], v[6:7]", 8),
            [16.0, 0.0, 0.0]
        );
        assert_eq!(
            cycles("image_sample v[0:3], v[0:1], s[0:7], s[8:11] dmask:0xf", 8),
            [0.0, 16.0, 0.0]
        );
        assert_eq!(
            cycles("image_load v[0:3], v[0:1], s[0:7] dmask:0xf", 16),
            [0.0, 32.0, 0.0]
        );
        // The camera's depth in a shader that also reads a wide map.
        assert_eq!(
            cycles("image_load v0, v[0:1], s[0:7] dmask:0x1", 16),
            [0.0, 16.0, 0.0]
        );
        assert_eq!(
            cycles("image_store v[0:3], v[4:5], s[0:7] dmask:0xf", 8),
            [0.0, 16.0, 0.0]
        );
        assert_eq!(cycles("s_load_dwordx8 s[0:7], s[2:3], null", 8), [0.0; 3]);
        assert_eq!(cycles("exp mrt0 v0, v0, v1, v1 done compr vm", 8), [0.0; 3]);
        assert_eq!(cycles("ds_read_b128 v[0:3], v4", 8), [0.0, 0.0, 8.0]);
        assert_eq!(
            cycles("ds_write2_b32 v0, v1, v2 offset1:1", 8),
            [0.0, 0.0, 4.0]
        );
        assert_eq!(cycles("ds_read_b32 v0, v1", 8), [0.0, 0.0, 2.0]);
    }
}
