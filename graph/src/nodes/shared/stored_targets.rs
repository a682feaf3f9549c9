//! How many lights leave a compute shader: a storage texture for each four of them.

use moment_shadows::TextureFormat::{self, Rgba16Float};

use super::shading::numbered;

/// The variable of the first of these.
pub(super) const STORED: &str = "stored_intensity";

/// The module `shade_targets` for the outputs whose first lights these are.
pub(super) fn module(firsts: impl Iterator<Item = u32> + Clone, format: TextureFormat) -> String {
    // A driver may truncate.
    let rounded = |value: &str| match format {
        Rgba16Float => format!("storage_round_to_float16({value})"),
        _ => value.to_owned(),
    };
    let variable = |first: u32| {
        format!(
            "@group(GROUP) @binding({}) var {}: texture_storage_2d<{format}, write>;\n",
            11 + first / 4,
            numbered(STORED, first)
        )
    };
    let store = |first: u32| {
        format!(
            "    textureStore({}, pixel, {});\n",
            numbered(STORED, first),
            rounded(&format!("intensities[{}]", first / 4))
        )
    };
    let import = match format {
        Rgba16Float => "import moment_shadows::map::storage::{storage_round_to_float16};\n",
        _ => "",
    };
    let variables: String = firsts.clone().map(variable).collect();
    let stores: String = firsts.map(store).collect();
    format!(
        "\
{import}import node::specialization::{{GROUP, TARGETS}};

{variables}
fn shade_store(pixel: vec2i, intensities: array<vec4f, TARGETS>) {{
{stores}}}
"
    )
}
