//! The generated module `specialization`: what a node's shader imports because it cannot be an ordinary value.
//!
//! Formats of storage textures are literals of a type, bind groups are attributes, unrolled loops are text. Nothing else
//! is generated.

use core::fmt::Write;

use moment_shadows::{Source, link};

use crate::{Capabilities, GraphError, GraphErrorKind};

/// The text of a `specialization` module.
#[derive(Clone, Debug)]
pub(in crate::nodes) struct Specialization {
    text: String,
}

impl Specialization {
    /// A module that knows the bind group.
    pub(in crate::nodes) fn new(capabilities: &Capabilities) -> Self {
        Self {
            text: format!("const GROUP = {};\n", capabilities.bind_group),
        }
    }

    pub(in crate::nodes) fn alias(mut self, name: &str, of: &str) -> Self {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "alias {name} = {of};");
        self
    }

    pub(in crate::nodes) fn constant(mut self, name: &str, value: &str) -> Self {
        let _ = writeln!(self.text, "const {name} = {value};");
        self
    }

    /// A constant of type u32.
    pub(in crate::nodes) fn unsigned(self, name: &str, value: u32) -> Self {
        self.constant(name, &format!("{value}u"))
    }

    pub(in crate::nodes) fn text(mut self, text: &str) -> Self {
        self.text.push_str(text);
        self
    }

    /// Links a node's shader, a file with its text, with this module and further ones.
    pub(in crate::nodes) fn link(
        &self,
        (name, text): (&str, &str),
        others: &[(&str, &str)],
    ) -> Result<String, GraphError> {
        let mut generated = vec![Source {
            name: "specialization",
            text: &self.text,
        }];
        generated.extend(others.iter().map(|&(name, text)| Source { name, text }));
        let linked = link(Source { name, text }, &generated)
            .map_err(|error| GraphError::new(GraphErrorKind::Shader, error.to_string()))?;
        Ok(linked.into_wgsl())
    }
}
