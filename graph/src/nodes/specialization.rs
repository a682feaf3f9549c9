//! The generated module `specialization`: what a node's shader imports because it cannot be an ordinary value.
//!
//! Formats of storage textures are literals of a type, bind groups are attributes, unrolled loops are text. Nothing else
//! is generated.

use core::fmt::Write;

use moment_shadows::{Source, link};

use crate::{Capabilities, GraphError, GraphErrorKind};

/// The virtual module with the vertex stage of fullscreen passes.
pub(super) const FULLSCREEN: (&str, &str) = ("fullscreen", include_str!("fullscreen.wgsl"));

/// The text of a `specialization` module.
#[derive(Clone, Debug)]
pub(super) struct Specialization {
    text: String,
}

impl Specialization {
    /// A module that knows the bind group.
    pub(super) fn new(capabilities: &Capabilities) -> Self {
        Self {
            text: format!("const GROUP = {};\n", capabilities.bind_group),
        }
    }

    pub(super) fn alias(mut self, name: &str, of: &str) -> Self {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "alias {name} = {of};");
        self
    }

    pub(super) fn constant(mut self, name: &str, value: &str) -> Self {
        let _ = writeln!(self.text, "const {name} = {value};");
        self
    }

    pub(super) fn text(mut self, text: &str) -> Self {
        self.text.push_str(text);
        self
    }

    /// Links a node's shader with this module and further ones.
    pub(super) fn link(
        &self,
        file: &str,
        shader: &str,
        others: &[(&str, &str)],
    ) -> Result<String, GraphError> {
        let mut generated = vec![Source {
            name: "specialization",
            text: &self.text,
        }];
        generated.extend(others.iter().map(|&(name, text)| Source { name, text }));
        let linked = link(
            Source {
                name: file,
                text: shader,
            },
            &generated,
        )
        .map_err(|error| GraphError::new(GraphErrorKind::Shader, error.to_string()))?;
        Ok(linked.into_wgsl())
    }
}
