//! The generated module `specialization`: what a node's shader imports because it cannot be an ordinary value.
//!
//! Formats of storage textures are literals of a type, bind groups are attributes, unrolled loops are text. What else is generated
//! comes from the rows of techniques.

use core::fmt::Write;

use moment_shadows::{Source, link};

use crate::{Capabilities, GraphError, GraphErrorKind};

/// The text of a `specialization` module.
#[derive(Clone, Debug)]
pub(in crate::nodes) struct Specialization {
    text: String,
    modules: Vec<(&'static str, String)>,
}

impl Specialization {
    /// A module that knows the bind group.
    pub(in crate::nodes) fn new(capabilities: &Capabilities) -> Self {
        Self {
            text: format!("const GROUP = {};\n", capabilities.bind_group),
            modules: Vec::new(),
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

    /// A further generated module.
    pub(in crate::nodes) fn module(mut self, name: &'static str, text: String) -> Self {
        self.modules.push((name, text));
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
        let own = self.modules.iter();
        generated.extend(own.map(|(name, text)| Source { name, text }));
        generated.extend(others.iter().map(|&(name, text)| Source { name, text }));
        let linked = link(Source { name, text }, &generated)
            .map_err(|error| GraphError::new(GraphErrorKind::Shader, error.to_string()))?;
        Ok(linked.into_wgsl())
    }
}
