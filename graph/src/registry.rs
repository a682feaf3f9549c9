//! Node types by name: ours, and a host's own.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;

use crate::{Node, nodes};

/// Makes a node of its properties, which are JSON text.
type Factory = fn(&str) -> Result<Box<dyn Node>, serde_json::Error>;

/// The node types that a graph file can name.
#[derive(Clone, Debug)]
pub struct NodeRegistry {
    factories: BTreeMap<String, Factory>,
}

impl NodeRegistry {
    /// The library's own node types.
    #[must_use]
    pub fn new() -> Self {
        let mut registry = Self {
            factories: BTreeMap::new(),
        };
        nodes::register(&mut registry);
        registry
    }

    /// Adds a node type, whose properties are what `N` deserialises from. It should deny unknown fields. A type of the
    /// same name is replaced.
    pub fn register<N: Node + DeserializeOwned + 'static>(&mut self, type_name: &str) {
        let factory: Factory = |properties| Ok(Box::new(serde_json::from_str::<N>(properties)?));
        self.factories.insert(type_name.to_owned(), factory);
    }

    /// The names of all node types.
    pub fn type_names(&self) -> impl Iterator<Item = &str> {
        self.factories.keys().map(String::as_str)
    }

    /// A node of a type; `None` if nobody registered it.
    pub(crate) fn create(
        &self,
        type_name: &str,
        properties: &str,
    ) -> Option<Result<Box<dyn Node>, serde_json::Error>> {
        let factory = self.factories.get(type_name)?;
        Some(factory(properties))
    }
}

impl Default for NodeRegistry {
    fn default() -> Self {
        Self::new()
    }
}
