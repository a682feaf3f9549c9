//! A graph file, as sub-commands read it.

use std::path::Path;

use serde_json::Value;

use super::{CommandError, output, read};
use crate::graph::LARGEST_FILE;
use crate::{Capabilities, Graph, Plan, ResourceDesc};

/// A graph file of the library's own nodes.
#[derive(Debug)]
pub struct GraphFile {
    /// Its name, for errors.
    pub name: String,
    /// Its text, in the current version of the format.
    pub text: String,
    /// The graph.
    pub graph: Graph,
}

impl GraphFile {
    /// Reads a file, and says which of its names are old.
    ///
    /// # Errors
    /// [`CommandError::Read`] or [`CommandError::Graph`].
    pub fn read(path: &Path) -> Result<Self, CommandError> {
        let file = Self::parse(&path.display().to_string(), read::read(path, LARGEST_FILE)?)?;
        for note in &file.graph.notes {
            output::say(format_args!(
                "note: {} is of version 1: {note} now",
                file.name
            ));
        }
        Ok(file)
    }

    /// The graph of a text that errors name by `name`.
    ///
    /// # Errors
    /// [`CommandError::Graph`].
    pub fn parse(name: &str, mut text: String) -> Result<Self, CommandError> {
        // The text as given is parsed, so that errors have its positions.
        let graph: Graph = text.parse().map_err(CommandError::graph(name))?;
        if !graph.notes.is_empty() {
            let mut file: Value = serde_json::from_str(&text)?;
            Graph::upgrade(&mut file);
            text = file.to_string();
        }
        let name = name.to_owned();
        Ok(Self { name, text, graph })
    }

    /// Compiles it without a device, with imports as the file expects them but for those that are given.
    ///
    /// # Errors
    /// [`CommandError::Graph`].
    pub fn compile(
        &self,
        capabilities: &Capabilities,
        imports: &[(&str, ResourceDesc)],
    ) -> Result<Plan, CommandError> {
        let plan = self.graph.compile(capabilities, imports);
        plan.map_err(CommandError::graph(&self.name))
    }
}
