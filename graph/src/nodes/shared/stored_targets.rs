//! How many lights leave a compute shader: a storage texture for each four of them.

use moment_shadows::TextureFormat;

use super::shading::numbered;

/// The variable of the first of these.
pub(super) const STORED: &str = "stored_intensity";

/// The module `shade_targets` for the outputs whose first lights these are.
pub(super) fn module(firsts: impl Iterator<Item = u32> + Clone, format: TextureFormat) -> String {
    let variable = |first: u32| {
        format!(
            "@group(GROUP) @binding({}) var {}: texture_storage_2d<{format}, write>;\n",
            12 + first / 4,
            numbered(STORED, first)
        )
    };
    let store = |first: u32| {
        format!(
            "    textureStore({}, pixel, intensities[{}]);\n",
            numbered(STORED, first),
            first / 4
        )
    };
    let variables: String = firsts.clone().map(variable).collect();
    let stores: String = firsts.map(store).collect();
    format!(
        "\
import node::specialization::{{GROUP, TARGETS}};

{variables}
fn shade_store(pixel: vec2i, intensities: array<vec4f, TARGETS>) {{
{stores}}}
"
    )
}
