//! The graph file: imports, nodes, edges, outputs.

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

use crate::error::{ensure, unknown};
use crate::nodes::REFUSED;
use crate::version_1::Renamed;
use crate::{GraphError, GraphErrorKind, Node, NodeRegistry, Position, ResourceDesc, TextureDesc};

/// The version of graph files and plans that this library writes. Graph files of version 1 are read, too.
pub(crate) const VERSION: u32 = 2;

/// A graph file of more bytes than this is refused: names are looked up one by one, so that time grows with the square.
pub(crate) const LARGEST_FILE: usize = 1 << 20;

/// A graph: nodes, and what connects them to each other and to the host.
#[derive(Debug, Default)]
pub struct Graph {
    /// What the host owns and gives, as the graph expects it; a host's own description takes its place.
    pub imports: Vec<Named<Option<ResourceDesc>>>,
    /// The nodes, in any order: each a type with its properties.
    pub nodes: Vec<Named<Box<dyn Node>>>,
    /// The connections.
    pub edges: Vec<Edge>,
    /// What the host takes: outputs of nodes (`node.slot`), or imports.
    pub outputs: Vec<Named<String>>,
    /// What to change in the file, a sentence each: names of an older version that it uses.
    pub notes: Vec<String>,
}

/// A part of a graph or of a plan, by name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Named<T> {
    /// The name, which nothing else of its kind has.
    pub name: String,
    /// What has the name; in a plan the index of a resource.
    #[serde(rename = "resource")]
    pub value: T,
    /// The place in the graph file, where there is one.
    #[serde(skip)]
    pub position: Option<Position>,
}

impl<T> Named<T> {
    /// Something without a place in a file.
    pub fn new(name: impl Into<String>, value: T) -> Self {
        Self {
            name: name.into(),
            value,
            position: None,
        }
    }

    fn at(self, position: Position) -> Self {
        Self {
            position: Some(position),
            ..self
        }
    }

    /// An error, said of this node.
    pub(crate) fn placed(&self, error: GraphError) -> GraphError {
        error.at_node(&self.name).at_position(self.position)
    }
}

/// A connection.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Edge {
    /// An output of a node (`node.slot`) or an import (`name`).
    pub from: String,
    /// An input of a node (`node.slot`).
    pub to: String,
    /// The place in the file.
    #[serde(skip)]
    pub position: Option<Position>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File<'a> {
    /// Already looked at; named here because other keys are refused.
    #[serde(rename = "version")]
    _version: serde::de::IgnoredAny,
    /// Where the schema is, for editors.
    #[serde(rename = "$schema", default)]
    _schema: Option<&'a str>,
    /// For people: why the graph is as it is.
    #[serde(rename = "comment", default)]
    _comment: Option<String>,
    #[serde(borrow)]
    imports: Vec<&'a RawValue>,
    #[serde(borrow)]
    nodes: Vec<&'a RawValue>,
    #[serde(borrow)]
    edges: Vec<&'a RawValue>,
    #[serde(borrow)]
    outputs: Vec<&'a RawValue>,
}

/// Read first, so that a newer file is told apart from a mistyped one.
#[derive(Deserialize)]
struct FileVersion {
    version: u32,
}

/// What the host gives, and how the graph expects it.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct FileImport {
    /// The name, which nothing else has.
    name: String,
    /// A texture as the graph expects it; what the host gives may differ.
    #[serde(default)]
    texture: Option<TextureDesc>,
    /// The size of a storage buffer in bytes.
    #[serde(default)]
    buffer_size: Option<u64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileNode<'a> {
    name: String,
    r#type: String,
    #[serde(borrow, default)]
    properties: Option<&'a RawValue>,
}

/// What the host takes.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct FileOutput {
    /// The name, which no other output has.
    name: String,
    /// An output of a node (`node.slot`), or an import (`name`).
    from: String,
}

impl Graph {
    /// Reads a graph file. Names and connections are checked by [`compile`](Self::compile).
    pub fn parse(text: &str, registry: &NodeRegistry) -> Result<Self, GraphError> {
        ensure(text.len() <= LARGEST_FILE, GraphErrorKind::Size, || {
            format!(
                "the file has {} bytes; at most {LARGEST_FILE} are read",
                text.len()
            )
        })?;
        let FileVersion { version } = read(text, text)?;
        let known = (1..=VERSION).contains(&version);
        ensure(known, GraphErrorKind::Version, || {
            format!(
                "the file has version {version}, this library reads versions 1 to {VERSION}; use a library of the file's version"
            )
        })?;
        let file: File<'_> = read(text, text)?;
        let mut renamed = (version == 1).then(Renamed::default);
        let mut graph = Self {
            imports: each(text, &file.imports, read_import)?,
            nodes: each(text, &file.nodes, |raw: &RawValue, position| {
                read_node(text, raw.get(), position, registry, renamed.as_mut())
            })?,
            edges: each(text, &file.edges, |edge: Edge, position| {
                let position = Some(position);
                Ok(Edge { position, ..edge })
            })?,
            outputs: each(text, &file.outputs, |output: FileOutput, position| {
                Ok(Named::new(output.name, output.from).at(position))
            })?,
            notes: Vec::new(),
        };
        if let Some(mut renamed) = renamed {
            let edges = graph.edges.iter_mut();
            let ends = edges.flat_map(|edge| [&mut edge.from, &mut edge.to]);
            ends.chain(graph.outputs.iter_mut().map(|output| &mut output.value))
                .for_each(|end| renamed.endpoint(end));
            graph.notes = renamed.notes;
        }
        Ok(graph)
    }
}

/// A graph file of the library's own nodes.
impl core::str::FromStr for Graph {
    type Err = GraphError;

    fn from_str(text: &str) -> Result<Self, GraphError> {
        Self::parse(text, &NodeRegistry::new())
    }
}

fn each<'a, F: Deserialize<'a>, T>(
    text: &str,
    values: &[&'a RawValue],
    mut one: impl FnMut(F, Position) -> Result<T, GraphError>,
) -> Result<Vec<T>, GraphError> {
    let (mut position, mut offset) = (Position::START, 0);
    values
        .iter()
        .map(|raw| {
            let begin = offset_in(text, raw.get());
            position = position.after(text.as_bytes().get(offset..begin).unwrap_or_default());
            offset = begin;
            one(read(text, raw.get())?, position)
        })
        .collect()
}

/// Where `part`, a slice of `text`, begins.
fn offset_in(text: &str, part: &str) -> usize {
    (part.as_ptr() as usize).saturating_sub(text.as_ptr() as usize)
}

/// Reads `part` of `text`; errors are placed in the whole text.
fn read<'a, T: Deserialize<'a>>(text: &str, part: &'a str) -> Result<T, GraphError> {
    serde_json::from_str(part).map_err(|error| syntax(text, part, &error))
}

fn syntax(text: &str, part: &str, error: &serde_json::Error) -> GraphError {
    // serde_json counts lines and columns from 1 within the part; column 0 is the end of the line before.
    let line_start = part
        .split_inclusive('\n')
        .take(error.line().saturating_sub(1))
        .map(str::len)
        .sum::<usize>();
    let within = (line_start + error.column().saturating_sub(1)).min(part.len());
    let end = offset_in(text, part) + within;
    let before = text.as_bytes().get(..end).unwrap_or(text.as_bytes());
    GraphError::new(GraphErrorKind::Syntax, sentence(error))
        .at_position(Some(Position::START.after(before)))
}

/// What is wrong, without the place within the part that was read.
fn sentence(error: &serde_json::Error) -> String {
    let full = error.to_string();
    full.rsplit_once(" at line ")
        .map_or(full.as_str(), |(sentence, _)| sentence)
        .to_owned()
}

fn read_import(
    import: FileImport,
    position: Position,
) -> Result<Named<Option<ResourceDesc>>, GraphError> {
    let both = import.texture.is_some() && import.buffer_size.is_some();
    ensure(!both, GraphErrorKind::Syntax, || {
        format!(
            "import '{}' is given as a texture and as a buffer; keep one of them",
            import.name
        )
    })
    .map_err(|error| error.at_position(Some(position)))?;
    let texture = import.texture.map(ResourceDesc::Texture);
    let buffer = import.buffer_size.map(|size| ResourceDesc::Buffer { size });
    Ok(Named::new(import.name, texture.or(buffer)).at(position))
}

fn read_node(
    text: &str,
    raw: &str,
    position: Position,
    registry: &NodeRegistry,
    renamed: Option<&mut Renamed>,
) -> Result<Named<Box<dyn Node>>, GraphError> {
    let header: FileNode<'_> = read(text, raw).map_err(|error| match name_of(raw) {
        Some(name) => error.at_node(&name),
        None => error,
    })?;
    let properties = header.properties.map_or("{}", RawValue::get);
    let type_name = match renamed {
        Some(renamed) => renamed.type_name(&header.name, &header.r#type),
        None => &header.r#type,
    };
    let node = registry
        .create(type_name, properties)
        .ok_or_else(|| unknown_type(type_name, registry))
        .and_then(|result| {
            result.map_err(|error| match header.properties {
                Some(_) => {
                    refused(type_name, &error).unwrap_or_else(|| syntax(text, properties, &error))
                }
                None => GraphError::new(
                    GraphErrorKind::Syntax,
                    format!("{}; give it in the node's 'properties'", sentence(&error)),
                ),
            })
        })
        .map_err(|error| error.at_node(&header.name).at_position(Some(position)))?;
    Ok(Named::new(header.name, node).at(position))
}

/// The reason why a node does not have a property that a file gives it, if one is known.
fn refused(type_name: &str, error: &serde_json::Error) -> Option<GraphError> {
    let message = error.to_string();
    let (_, key, reason) = REFUSED.into_iter().find(|(of, key, _)| {
        *of == type_name && message.starts_with(&format!("unknown field `{key}`"))
    })?;
    Some(GraphError::new(
        GraphErrorKind::Property,
        format!("'{key}' is refused: {reason}"),
    ))
}

/// The name of a node whose description is wrong elsewhere.
fn name_of(raw: &str) -> Option<String> {
    let node: serde_json::Value = serde_json::from_str(raw).ok()?;
    Some(node["name"].as_str()?.to_owned())
}

fn unknown_type(type_name: &str, registry: &NodeRegistry) -> GraphError {
    let remark = "types of its own a host registers";
    let error = unknown("node type", type_name, registry.type_names(), remark);
    GraphError {
        kind: GraphErrorKind::UnknownNodeType,
        ..error
    }
}
