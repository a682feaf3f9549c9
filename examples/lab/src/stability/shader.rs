//! The shader of a technique and a storage: the adapters that the nodes link, with texels in place of textures.

use moment_shadows::{EsmFiltering, Kernel, LinkError, MapEncoding, Source, Technique, link};

use super::input::Input;
use super::kernels::{kernels, table};
use crate::batch::Batch;
use crate::error::LabError;
use crate::gpu::Gpu;

/// The adapter of the nodes that a file's name stands for.
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

fn linked(encoding: &MapEncoding) -> Result<String, LinkError> {
    let specialization = specialization(encoding);
    let technique = encoding.technique();
    let [filtering, encode, evaluate] = adapters(technique);
    // The node makes a plane per pass, here they are made in turn.
    let planes = "var<private> PLANE: u32;";
    let mut encode = encode.replace("override PLANE: u32;", planes);
    if !encode.contains(planes) {
        encode = format!("{encode}\n{planes}\n");
    }
    let modules = [
        ("specialization", specialization.as_str()),
        ("map_encoding", &encode),
        ("map_filtering", filtering),
        ("map_texel", include_str!("map_texel.wgsl")),
        ("technique", evaluate),
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

/// How texels are filtered, encoded and evaluated.
fn adapters(technique: &Technique) -> [&'static str; 3] {
    let linear = adapter!("filter_linear.wgsl");
    match technique {
        Technique::Esm {
            filtering: EsmFiltering::Logarithmic,
            ..
        } => [
            adapter!("filter_logarithmic.wgsl"),
            adapter!("encode_exponential.wgsl"),
            include_str!("evaluate_exponential_logarithmic.wgsl"),
        ],
        Technique::Esm { .. } => [
            linear,
            adapter!("encode_exponential.wgsl"),
            adapter!("evaluate_exponential.wgsl"),
        ],
        Technique::Vsm => [
            linear,
            adapter!("encode_variance.wgsl"),
            adapter!("evaluate_variance.wgsl"),
        ],
        Technique::Evsm2 { .. } | Technique::Evsm4 { .. } => [
            linear,
            adapter!("encode_exponential_variance.wgsl"),
            adapter!("evaluate_exponential_variance.wgsl"),
        ],
        Technique::Lvsm { .. } => [
            linear,
            adapter!("encode_layered_variance.wgsl"),
            adapter!("evaluate_layered_variance.wgsl"),
        ],
        Technique::Convolution { .. } => [
            linear,
            adapter!("encode_convolution.wgsl"),
            adapter!("evaluate_convolution.wgsl"),
        ],
        Technique::Hausdorff4 => [
            linear,
            adapter!("encode_four_moments.wgsl"),
            adapter!("evaluate_hausdorff4.wgsl"),
        ],
        Technique::Hamburger6 => [
            linear,
            adapter!("encode_six_moments.wgsl"),
            adapter!("evaluate_hamburger6.wgsl"),
        ],
        _ => [
            linear,
            adapter!("encode_four_moments.wgsl"),
            adapter!("evaluate_hamburger4.wgsl"),
        ],
    }
}

/// The constants that the adapters import.
fn specialization(encoding: &MapEncoding) -> String {
    let own = match encoding.technique() {
        Technique::Esm {
            exponent,
            filtering,
        } => format!(
            "const EXPONENT = f32({:?});\nconst LOGARITHMIC = {};\n",
            exponent.get(),
            *filtering == EsmFiltering::Logarithmic
        ),
        Technique::Evsm2 { exponent } => format!(
            "const EXPONENTS = vec2f({:?}, 0.0);\nconst BOTH_WARPS = false;\n",
            exponent.get()
        ),
        Technique::Evsm4 { positive, negative } => format!(
            "const EXPONENTS = vec2f({:?}, {:?});\nconst BOTH_WARPS = true;\n",
            positive.get(),
            negative.get()
        ),
        Technique::Lvsm {
            layers,
            overlap,
            splits,
        } => {
            // Splits that are placed on the device are no setting; any will do to show that nothing breaks.
            let mut known = splits.known(*layers).unwrap_or_default();
            known.resize(8, 1.0);
            format!(
                "const LAYERS = {layers}u;\nconst LAYER_OVERLAP = f32({:?});\n\
                 const LAYER_SPLITS_LOW = vec4f({:?}, {:?}, {:?}, {:?});\n\
                 const LAYER_SPLITS_HIGH = vec4f({:?}, {:?}, {:?}, {:?});\n",
                overlap.get(),
                known[0],
                known[1],
                known[2],
                known[3],
                known[4],
                known[5],
                known[6],
                known[7]
            )
        }
        Technique::Convolution { terms, lower_bound } => {
            format!("const TERMS = {terms}u;\nconst LOWER_BOUND = {lower_bound};\n")
        }
        _ => String::new(),
    };
    format!(
        "const STORAGE = {}u;\nconst PLANES = {}u;\nconst SPLIT_SUMS = {};\n{own}",
        encoding.storage().wgsl_index(),
        encoding.planes(),
        encoding.has_split_sums()
    )
}
