//! The one list of everything that the library hands to a shader compiler, for the tests and tools that judge it.

mod calls;
mod glsl;
mod spirv;
mod write;

use std::collections::BTreeMap;

use moment_shadows::{Profile, Source, link, modules};
use moment_shadows_graph::Pass;

use crate::catalogue;
use crate::error::LabError;

pub use calls::calls;
pub use spirv::Compiled;
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

/// A pass of a variant of a node.
#[derive(Clone, Debug)]
pub struct NodeShader {
    /// The node's name, by which the registry knows it.
    pub node: String,
    /// Its linked text.
    pub shader: Shader,
    /// Whether the text is kept as a snapshot.
    pub is_kept: bool,
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

/// The shader of each pass of every variant in the [`catalogue`], but texts that a variant has already.
pub fn nodes() -> Result<Vec<NodeShader>, LabError> {
    let mut all = Vec::new();
    for variant in catalogue::variants()? {
        let Some(file) = &variant.file else {
            continue;
        };
        let desc = variant.describe()?;
        // Passes that share a text differ by their constants only, and planes take turns.
        let mut passes: Vec<Pass> = Vec::new();
        for pass in desc.passes {
            if !passes.iter().any(|before| before.wgsl == pass.wgsl) {
                passes.push(pass);
            }
        }
        let several = passes.len() > 1;
        for (index, pass) in passes.into_iter().enumerate() {
            // Passes are told apart by the last words of their labels: "blur along x", "blur along y".
            let last = pass.label.rsplit(' ').next().filter(|_| several);
            let suffix = last.map(|word| format!("_{word}")).unwrap_or_default();
            all.push(NodeShader {
                node: desc.name.clone(),
                shader: Shader {
                    name: format!("{file}{suffix}"),
                    kind: Kind::Node,
                    profile: variant.profile(),
                    wgsl: pass.wgsl,
                    constants: pass.constants,
                },
                is_kept: index < variant.kept,
            });
        }
    }
    Ok(all)
}

/// Everything, in a fixed order. Modules come from the library's own registry, nodes from the [`catalogue`].
pub fn all() -> Result<Vec<Shader>, LabError> {
    let core = |name: String, kind, wgsl| Shader {
        name,
        kind,
        profile: Profile::WebgpuCore,
        wgsl,
        constants: BTreeMap::new(),
    };
    let mut all = Vec::new();
    for module in modules() {
        let (name, text) = (module.name, module.source);
        let linked = link(Source { name, text }, &[])?.into_wgsl();
        let called = calls(text, &linked);
        all.push(core(format!("calls_{name}"), Kind::Calls, called));
        all.push(core(format!("module_{name}"), Kind::Module, linked));
    }
    all.extend(nodes()?.into_iter().map(|node| node.shader));
    let example = Source {
        name: "forward_shading.wgsl",
        text: include_str!("../../../forward_shading.wgsl"),
    };
    let name = "example_forward_shading".to_owned();
    all.push(core(name, Kind::Example, link(example, &[])?.into_wgsl()));
    Ok(all)
}
