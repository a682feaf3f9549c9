//! The shader of a technique and a storage: the modules that the nodes link, with texels in place of textures.

use moment_shadows::{Kernel, MapEncoding, Row, ShaderError, Source, link};

use super::input::Input;
use super::kernels::{kernels, table};
use super::packed_limits::receiver_bias;
use crate::batch::Batch;
use crate::error::LabError;
use crate::gpu::Gpu;

/// The file of the nodes that has this name.
macro_rules! adapter {
    ($file:literal) => {
        include_str!(concat!("../../../../graph/src/nodes/techniques/", $file))
    };
}

/// Runs inputs through one technique with one storage.
pub struct Evaluator<'gpu> {
    batch: Batch<'gpu, Input, f32>,
    kernels: Vec<Kernel>,
}

impl<'gpu> Evaluator<'gpu> {
    /// Compiles the shader.
    pub fn new(gpu: &'gpu Gpu, encoding: &MapEncoding) -> Result<Self, LabError> {
        let kernels = kernels()?;
        let wgsl = linked(encoding)?;
        let label = encoding.to_string();
        Ok(Self {
            batch: Batch::with_table(gpu, &label, &wgsl, &table(&kernels))?,
            kernels,
        })
    }

    /// The shadow intensities.
    pub fn run(&self, inputs: &[Input]) -> Result<Vec<f32>, LabError> {
        self.batch.run(inputs)
    }

    /// The kernels of patches.
    #[must_use]
    pub fn kernels(&self) -> &[Kernel] {
        &self.kernels
    }
}

fn linked(encoding: &MapEncoding) -> Result<String, ShaderError> {
    let row = encoding.technique().row();
    let specialization = specialization(encoding, &row);
    // The node makes a plane per pass, here they are made in turn.
    let planes = "var<private> PLANE: u32;";
    let mut encode = row.map_encoding().replace("override PLANE: u32;", planes);
    if !encode.contains(planes) {
        encode = format!("{encode}\n{planes}\n");
    }
    // Logarithms are decoded before they are blended: there is no filtered texel.
    let evaluate = if row.averaged_by_samplers {
        row.technique()
    } else {
        include_str!("evaluate_exponential_logarithmic.wgsl").to_owned()
    };
    let filtering = row.map_filtering();
    let modules = [
        ("specialization", specialization.as_str()),
        ("map_encoding", &encode),
        ("map_filtering", &filtering),
        ("map_texel", include_str!("map_texel.wgsl")),
        ("technique", &evaluate),
        ("technique_layers", adapter!("layers_known.wgsl")),
        ("technique_receiver", adapter!("receiver.wgsl")),
    ]
    .map(|(name, text)| Source { name, text });
    let shader = Source {
        name: "evaluate.wgsl",
        text: include_str!("evaluate.wgsl"),
    };
    Ok(link(shader, &modules)?.into_wgsl())
}

/// How many taps a kernel has at least whose sums are split.
fn split_sums_from(encoding: &MapEncoding) -> u32 {
    let radius = (0..=Kernel::LARGEST_RADIUS).find(|&radius| encoding.has_split_sums(radius));
    radius.map_or(u32::MAX, |radius| 2 * radius + 1)
}

/// The constants that the modules import.
fn specialization(encoding: &MapEncoding, row: &Row) -> String {
    let mut own: String = row
        .constants()
        .map(|(name, value)| format!("const {name} = {value};\n"))
        .collect();
    if row.places_layers {
        // Splits that are placed on the device are not a setting; any will do to show that nothing breaks.
        own += "const LAYER_SPLITS_LOW = vec4f(1.0);\nconst LAYER_SPLITS_HIGH = vec4f(1.0);\n";
    }
    format!(
        "const STORAGE = {}u;\nconst PLANES = {}u;\nconst SPLIT_SUMS_FROM = {}u;\nconst RECEIVER_BIAS: f32 = {:e};\n{own}",
        encoding.storage().wgsl_index(),
        encoding.planes(),
        split_sums_from(encoding),
        receiver_bias(encoding.storage())
    )
}
