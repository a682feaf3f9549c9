//! Which extensions of glTF are read, and what becomes of the others.

/// Extensions that are treated alike.
#[derive(Debug)]
pub struct Extensions {
    /// What becomes of them.
    pub what: &'static str,
    /// Whether a file that uses one may cast other shadows than ours, so that there is a warning.
    warned: bool,
    /// Whether a file that requires one is shown.
    shown: bool,
    /// Their names.
    pub names: &'static [&'static str],
}

/// All extensions that are known. One that is not is treated as those of the last row.
pub const EXTENSIONS: [Extensions; 4] = [
    Extensions {
        what: "read",
        warned: false,
        shown: true,
        names: &[
            "EXT_mesh_gpu_instancing",
            "KHR_mesh_quantization",
            "KHR_node_visibility",
            "KHR_texture_transform",
        ],
    },
    Extensions {
        what: "left out, since no shadow depends on it",
        warned: false,
        shown: true,
        names: &[
            "KHR_lights_punctual",
            "KHR_materials_anisotropy",
            "KHR_materials_clearcoat",
            "KHR_materials_dispersion",
            "KHR_materials_emissive_strength",
            "KHR_materials_ior",
            "KHR_materials_iridescence",
            "KHR_materials_sheen",
            "KHR_materials_specular",
            "KHR_materials_unlit",
            "KHR_node_hoverability",
            "KHR_node_selectability",
            "KHR_xmp",
            "KHR_xmp_json_ld",
            "EXT_instance_features",
            "EXT_lights_ies",
            "EXT_lights_image_based",
            "EXT_mesh_features",
            "EXT_mesh_manifold",
            "EXT_structural_metadata",
            "CESIUM_primitive_outline",
            "FB_geometry_metadata",
            "GODOT_single_root",
            "MSFT_packing_normalRoughnessMetallic",
            "MSFT_packing_occlusionRoughnessMetallic",
        ],
    },
    Extensions {
        what: "left out with a warning, since light passes or holes lie elsewhere",
        warned: true,
        shown: true,
        names: &[
            "KHR_materials_diffuse_transmission",
            "KHR_materials_pbrSpecularGlossiness",
            "KHR_materials_transmission",
            "KHR_materials_variants",
            "KHR_materials_volume",
        ],
    },
    Extensions {
        what: "left out with a warning, and refused where the file requires it",
        warned: true,
        shown: false,
        names: &[
            "KHR_animation_pointer",
            "KHR_draco_mesh_compression",
            "KHR_gaussian_splatting",
            "KHR_interactivity",
            "KHR_meshopt_compression",
            "KHR_techniques_webgl",
            "KHR_texture_basisu",
            "EXT_meshopt_compression",
            "EXT_texture_avif",
            "EXT_texture_webp",
            "MSFT_lod",
            "MSFT_texture_dds",
        ],
    },
];

fn row(name: &str) -> Option<&'static Extensions> {
    EXTENSIONS.iter().find(|row| row.names.contains(&name))
}

/// Whether a file that needs this extension is shown.
pub(super) fn is_shown(name: &str) -> bool {
    row(name).is_some_and(|row| row.shown)
}

/// Whether shadows may differ without this extension.
pub(super) fn is_warned_of(name: &str) -> bool {
    row(name).is_none_or(|row| row.warned)
}
