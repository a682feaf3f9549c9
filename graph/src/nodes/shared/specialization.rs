//! The modules that a node's description makes for its shader, `specialization` among them: what cannot be an ordinary value.
//! Formats of storage textures are literals of a type, bind groups are attributes, unrolled loops are text.

use core::fmt::{Display, Write};
use std::borrow::Cow;

use moment_shadows::{Source, link};

use crate::{Capabilities, GraphError, GraphErrorKind};

/// The text of the module `specialization`, and the further modules of a shader.
#[derive(Clone, Debug)]
pub(in crate::nodes) struct Specialization {
    text: String,
    modules: Vec<(String, Cow<'static, str>)>,
}

impl Specialization {
    /// A module that knows the bind group, and those that any shader can import.
    pub(in crate::nodes) fn new(capabilities: &Capabilities) -> Self {
        let receiver = include_str!("../techniques/receiver.wgsl");
        Self {
            text: format!("const GROUP = {};\n", capabilities.bind_group),
            modules: Vec::new(),
        }
        .module("fullscreen", include_str!("fullscreen.wgsl"))
        .module("regions", include_str!("regions.wgsl"))
        .module("map_texel", include_str!("../techniques/map_texel.wgsl"))
        .module("technique_receiver", receiver)
    }

    pub(in crate::nodes) fn alias(mut self, name: &str, of: &str) -> Self {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "alias {name} = {of};");
        self
    }

    pub(in crate::nodes) fn constant(mut self, name: &str, value: impl Display) -> Self {
        let _ = writeln!(self.text, "const {name} = {value};");
        self
    }

    /// A constant of type u32.
    pub(in crate::nodes) fn unsigned(self, name: &str, value: u32) -> Self {
        self.constant(name, format_args!("{value}u"))
    }

    /// A constant of type vec2u.
    pub(in crate::nodes) fn pair(self, name: &str, [x, y]: [u32; 2]) -> Self {
        self.constant(name, format_args!("vec2u({x}u, {y}u)"))
    }

    /// A further module.
    pub(in crate::nodes) fn module(
        mut self,
        name: &str,
        text: impl Into<Cow<'static, str>>,
    ) -> Self {
        self.modules.push((name.to_owned(), text.into()));
        self
    }

    /// Links a node's shader, a file with its text.
    pub(in crate::nodes) fn link(&self, (name, text): (&str, &str)) -> Result<String, GraphError> {
        let modules = self
            .modules
            .iter()
            .map(|(name, text)| Source { name, text });
        let generated: Vec<Source<'_>> = modules
            .chain([Source {
                name: "specialization",
                text: &self.text,
            }])
            .collect();
        let linked = link(Source { name, text }, &generated)
            .map_err(|error| GraphError::new(GraphErrorKind::Shader, error.to_string()))?;
        Ok(linked.into_wgsl())
    }
}
