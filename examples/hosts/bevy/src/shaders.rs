//! The library's modules in Bevy's composer, and what the graph's technique supplies to the material's shader.

use bevy::prelude::*;
use moment_shadows_graph::GraphError;

use crate::compiled::{Compiled, unsuitable};
use crate::maps::kind;

/// Keeps the modules: Bevy drops a shader without a handle.
#[derive(Resource)]
pub(crate) struct Modules {
    _handles: Vec<Handle<Shader>>,
}

/// Registers the library's modules by their paths, and where the graph makes a map for materials, their shader with the modules
/// `node::...`, which are those of the map's technique.
pub(crate) fn register(
    compiled: &Compiled,
    shaders: &mut Assets<Shader>,
    extension: Handle<Shader>,
) -> Result<Modules, GraphError> {
    let mut handles = Vec::new();
    for module in moment_shadows::modules() {
        let path = format!(
            "embedded://moment_shadows/{}/{}.wesl",
            module.folder, module.name
        );
        handles.push(shaders.add(Shader::from_wesl(module.source, path)));
    }
    let Some((map, encoding)) = &compiled.map else {
        return Ok(Modules { _handles: handles });
    };
    let row = encoding.technique().row();
    let levels = if row.averaged_by_samplers {
        map.mips
    } else {
        1
    };
    let levels = if levels > 1 {
        "textureNumLevels(moments_map)"
    } else {
        "1u"
    };
    let mut constants = format!(
        "const STORAGE = {}u;\nconst PLANES = {}u;\nconst VIEWS = {}u;\nconst CAMERAS = {}u;\n",
        encoding.storage().wgsl_index(),
        row.planes,
        compiled.layers,
        compiled.cameras
    );
    for (name, value) in row.constants() {
        constants += &format!("const {name} = {value};\n");
    }
    let mut node = |name: &str, text: String| {
        let path = format!("embedded://node/{name}.wesl");
        handles.push(shaders.add(Shader::from_wesl(text, path)));
    };
    if let Some(table) = encoding.table() {
        let [width, height] = table.largest_kernel();
        constants += &format!(
            "const LARGEST_KERNEL = vec2f({width}.0, {height}.0);\nconst TABLE_UNIT = f32({}u);\nconst TABLE_ERROR = f32({:?});\n",
            table.unit(),
            table.error()
        );
        let text = row.soft_technique().ok_or_else(|| {
            unsuitable("there are no soft shadows by the technique of this table; give its map 'hamburger4' or 'vsm'")
        })?;
        node("technique", text);
        node(
            "technique_map",
            include_str!("shaders/table.wesl").to_owned(),
        );
        node(
            "technique_soft",
            include_str!("shaders/soft.wesl").to_owned(),
        );
    } else {
        let anisotropic = map.mips == 1 || compiled.capabilities.anisotropic_sampling;
        let sampled = row.averaged_by_samplers && anisotropic && kind(map, compiled) == 0;
        let lookup = match (sampled, kind(map, compiled)) {
            (true, _) => include_str!("shaders/lookup_sampled.wesl").to_owned(),
            (false, kind) => {
                let binding = if kind == 0 { "100" } else { "102" };
                include_str!("shaders/lookup_loaded.wesl").replace("BINDING", binding)
            }
        };
        let technique = row.technique();
        if technique.contains("technique_layers") {
            let text = include_str!("shaders/technique_layers.wesl");
            node("technique_layers", text.to_owned());
        }
        node("technique", technique);
        node("moments_lookup", lookup.replace("LEVELS", levels));
        node(
            "map_texel",
            include_str!("shaders/map_texel.wesl").to_owned(),
        );
        let text = include_str!("shaders/technique_map.wesl");
        node("technique_map", text.replace("LEVELS", levels));
    }
    node(
        "technique_receiver",
        include_str!("shaders/technique_receiver.wesl").to_owned(),
    );
    node("specialization", constants);
    let own = |name: &str| format!("embedded://moment_shadows_bevy/{name}.wesl");
    let parts = [
        ("shadow_view", include_str!("shaders/shadow_view.wesl")),
        ("intensity", include_str!("shaders/intensity.wesl")),
        ("spots", include_str!("shaders/spots.wesl")),
    ];
    for (name, text) in parts {
        handles.push(shaders.add(Shader::from_wesl(text, own(name))));
    }
    let text = include_str!("shaders/extension.wesl");
    shaders
        .insert(&extension, Shader::from_wesl(text, own("extension")))
        .map_err(|error| unsuitable(error.to_string()))?;
    handles.push(extension);
    Ok(Modules { _handles: handles })
}
