//! The one list of everything that the library hands to a shader compiler, for the tests and tools that judge it.

mod calls;
mod error;
mod nodes;
mod spirv;
mod write;

use std::collections::BTreeMap;

use moment_shadows::{Profile, Source, link, link_module, modules};

pub use calls::calls;
pub use error::ShadersError;
pub use nodes::{NodeShader, nodes};
pub use spirv::{Compiled, Target};
pub use write::write;

/// A linked shader.
#[derive(Clone, Debug)]
pub struct Shader {
    /// A name that is a file name too: lower case, digits and underscores.
    pub name: String,
    /// What it was made of.
    pub kind: Kind,
    /// The least demanding profile that it is for.
    pub profile: Profile,
    /// The linked text.
    pub wgsl: String,
    /// Values for its `override` declarations.
    pub constants: BTreeMap<String, f64>,
}

/// What a shader was made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A module of the library with its closure: functions, no entry points.
    Module,
    /// A module of the library, each function of which is called from control flow that is not uniform.
    Calls,
    /// A pass of a node.
    Node,
    /// The shader of an example, as a user would write it.
    Example,
}

/// Everything, in a fixed order. Modules and the nodes' names come from the library's own registries, so only a node's
/// variants have to be written down ([`nodes()`]).
pub fn all() -> Result<Vec<Shader>, ShadersError> {
    let mut all = Vec::new();
    for module in modules() {
        let source = Source {
            name: module.name,
            text: module.source,
        };
        let linked = link_module(source)?.into_wgsl();
        all.push(Shader {
            name: format!("calls_{}", module.name),
            kind: Kind::Calls,
            profile: Profile::WebgpuCore,
            wgsl: calls(module.source, &linked),
            constants: BTreeMap::new(),
        });
        all.push(Shader {
            name: format!("module_{}", module.name),
            kind: Kind::Module,
            profile: Profile::WebgpuCore,
            wgsl: linked,
            constants: BTreeMap::new(),
        });
    }
    let nodes = nodes()?.into_iter();
    all.extend(nodes.map(|node| node.shader));
    all.push(Shader {
        name: "example_forward_shading".to_owned(),
        kind: Kind::Example,
        profile: Profile::WebgpuCore,
        wgsl: link(
            Source {
                name: "forward_shading.wgsl",
                text: include_str!("../../../forward_shading.wgsl"),
            },
            &[],
        )?
        .into_wgsl(),
        constants: BTreeMap::new(),
    });
    Ok(all)
}
