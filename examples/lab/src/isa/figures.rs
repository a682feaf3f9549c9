//! The figures of one shader on one chip.

use serde::{Deserialize, Serialize};

use super::chip::Chip;
use super::class::Class;
use super::compiler::Compiled;
use super::cycles;
use super::loops;
use super::subjects::Subject;
use super::text;
use crate::error::LabError;

/// What a compiled shader needs. Lower is better, in all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Figures {
    /// Instructions of the code.
    pub instructions: u64,
    /// Vector registers.
    pub vgprs: u64,
    /// Scalar registers.
    pub sgprs: u64,
    /// Bytes of workgroup memory.
    pub lds_bytes: u64,
    /// Bytes of the code.
    pub code_bytes: u64,
    /// The compiler's estimate of cycles per wave when many waves share a unit. Loops are weighed by a fixed factor.
    pub inverse_throughput: u64,
    /// The compiler's estimate of cycles of one wave, with the same weights.
    pub latency: u64,
    /// Vector instructions per output, here and below loops weighed by how often they run.
    pub valu: f64,
    /// Scalar instructions per output.
    pub salu: f64,
    /// Texture loads and samples per output.
    pub texture: f64,
    /// Loads from buffers per output.
    pub memory: f64,
    /// Accesses to workgroup memory per output.
    pub lds: f64,
    /// Stores and exports per output.
    pub store: f64,
    /// Cycles of the arithmetic units per 64 outputs, in the model of [`super::cycles`].
    pub alu_cycles: f64,
    /// Cycles of the texture unit per 64 outputs.
    pub texture_cycles: f64,
    /// Cycles of the LDS per 64 outputs.
    pub lds_cycles: f64,
}

/// A shader with its figures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The shader's name.
    pub shader: String,
    /// Its figures.
    pub figures: Figures,
}

impl Figures {
    /// Every figure with its name and the head of its column.
    #[must_use]
    pub fn named(&self) -> [(&'static str, &'static str, f64); 16] {
        [
            ("instructions", "instr", self.instructions as f64),
            ("VGPRs", "VGPR", self.vgprs as f64),
            ("SGPRs", "SGPR", self.sgprs as f64),
            ("LDS bytes", "LDS B", self.lds_bytes as f64),
            ("code bytes", "code B", self.code_bytes as f64),
            (
                "inverse throughput",
                "inv.thr",
                self.inverse_throughput as f64,
            ),
            ("latency", "latency", self.latency as f64),
            ("VALU per output", "VALU", self.valu),
            ("SALU per output", "SALU", self.salu),
            ("textures per output", "tex", self.texture),
            ("buffer loads per output", "mem", self.memory),
            ("LDS per output", "LDS", self.lds),
            ("stores per output", "store", self.store),
            ("ALU cycles", "cyc ALU", self.alu_cycles),
            ("texture cycles", "cyc tex", self.texture_cycles),
            ("LDS cycles", "cyc LDS", self.lds_cycles),
        ]
    }

    /// The figures of a compiled shader.
    pub(super) fn of(
        subject: &Subject,
        compiled: &Compiled,
        chip: Chip,
    ) -> Result<Figures, LabError> {
        let odd = |reason: String| {
            let shader = format!("shader '{}'", subject.name);
            LabError::unsuitable(shader, format!("on {chip}: {reason}"))
        };
        let statistic = |name: &str| {
            let value = compiled.executable.statistics.get(name).copied();
            let untold = || {
                format!("the driver does not tell '{name}'; use the version that the table names")
            };
            value.ok_or_else(|| odd(untold()))
        };
        let code = text::parse(&compiled.executable.isa).map_err(odd)?;
        let loops = loops::find(&code).map_err(odd)?;
        // Loops that run once may be unrolled; it makes no difference.
        let unrolled = loops.is_empty() && subject.trips.iter().all(|&trips| trips == 1);
        if loops.len() != subject.trips.len() && !unrolled {
            return Err(odd(format!(
                "its code has {} loops where the catalogue gives trip counts for {}; correct them there",
                loops.len(),
                subject.trips.len()
            )));
        }
        let weights = loops::weights(code.instructions.len(), &loops, &subject.trips);
        let mut figures = Figures {
            instructions: statistic("Instructions")?,
            vgprs: statistic("VGPRs")?,
            sgprs: statistic("SGPRs")?,
            lds_bytes: statistic("LDS size")?,
            code_bytes: statistic("Code size")?,
            inverse_throughput: statistic("Inverse Throughput")?,
            latency: statistic("Latency")?,
            ..Figures::default()
        };
        for (instruction, weight) in code.instructions.iter().zip(weights) {
            let per_output = weight / compiled.outputs;
            match instruction.class {
                Class::Valu => figures.valu += per_output,
                Class::Salu => figures.salu += per_output,
                Class::Texture => figures.texture += per_output,
                Class::Memory => figures.memory += per_output,
                Class::Lds => figures.lds += per_output,
                Class::Store => figures.store += per_output,
                Class::Control => {}
            }
            let cycles = cycles::of(instruction, subject.texel_bytes);
            figures.alu_cycles += cycles.alu * per_output;
            figures.texture_cycles += cycles.texture * per_output;
            figures.lds_cycles += cycles.lds * per_output;
        }
        Ok(figures)
    }
}
