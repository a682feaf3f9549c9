//! The graph file: imports, nodes, edges, outputs.

use moment_shadows::nearest;
use serde::Deserialize;
use serde_json::value::RawValue;

use crate::nodes::REFUSED;
use crate::version_1::Renamed;
use crate::{GraphError, GraphErrorKind, Node, NodeRegistry, Position, ResourceDesc};

/// The version of graph files and plans that this library writes. Graph files of version 1 are read, too.
pub const VERSION: u32 = 2;

/// A graph file of more bytes than this is refused: names are looked up one by one, so that time grows with the square.
const LARGEST_FILE: usize = 1 << 20;

/// A graph: nodes, and what connects them to each other and to the host.
#[derive(Debug)]
pub struct Graph {
    /// What the host owns and gives.
    pub imports: Vec<Import>,
    /// The nodes, in any order.
    pub nodes: Vec<GraphNode>,
    /// The connections.
    pub edges: Vec<Edge>,
    /// What the host takes.
    pub outputs: Vec<Output>,
    /// What to change in the file, a sentence each: names of an older version that it uses.
    pub notes: Vec<String>,
}

/// A resource that the host owns.
#[derive(Clone, Debug, PartialEq)]
pub struct Import {
    /// The name.
    pub name: String,
    /// What the graph expects; a host's own description takes its place.
    pub expected: Option<ResourceDesc>,
    /// The place in the file.
    pub position: Option<Position>,
}

/// A node of a graph.
#[derive(Debug)]
pub struct GraphNode {
    /// The name, unique within the graph.
    pub name: String,
    /// The type with its properties.
    pub node: Box<dyn Node>,
    /// The place in the file.
    pub position: Option<Position>,
}

/// A connection.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// An import (`name`) or an output of a node (`node.slot`).
    pub from: Endpoint,
    /// An input of a node.
    pub to: Endpoint,
    /// The place in the file.
    pub position: Option<Position>,
}

/// A resource that the host takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// The name.
    pub name: String,
    /// An output of a node.
    pub from: Endpoint,
    /// The place in the file.
    pub position: Option<Position>,
}

/// One end of an edge.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Endpoint {
    /// The node, or the import.
    pub owner: String,
    /// The slot of a node; `None` for an import.
    pub slot: Option<String>,
}

impl core::fmt::Display for Endpoint {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.owner)?;
        match &self.slot {
            Some(slot) => write!(f, ".{slot}"),
            None => Ok(()),
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File<'a> {
    /// Already looked at; named here because other keys are refused.
    #[serde(rename = "version")]
    _version: serde::de::IgnoredAny,
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

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileImport {
    name: String,
    #[serde(default)]
    texture: Option<crate::TextureDesc>,
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

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileEdge {
    from: String,
    to: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileOutput {
    name: String,
    from: String,
}

impl Graph {
    /// Reads a graph file. Names and connections are checked by [`crate::compile`].
    pub fn parse(text: &str, registry: &NodeRegistry) -> Result<Self, GraphError> {
        if text.len() > LARGEST_FILE {
            return Err(GraphError::new(
                GraphErrorKind::Size,
                format!(
                    "the file has {} bytes; at most {LARGEST_FILE} are read",
                    text.len()
                ),
            ));
        }
        let version: FileVersion = read(text, text)?;
        if !(1..=VERSION).contains(&version.version) {
            return Err(GraphError::new(
                GraphErrorKind::Version,
                format!(
                    "the file has version {}, this library reads versions 1 to {VERSION}; use a library of the file's version",
                    version.version
                ),
            ));
        }
        let file: File<'_> = read(text, text)?;
        let mut renamed = (version.version == 1).then(Renamed::default);
        let imports = each(text, &file.imports, read_import)?;
        let nodes = each(text, &file.nodes, |text, raw, position| {
            read_node(text, raw, position, registry, renamed.as_mut())
        })?;
        let mut edges = each(text, &file.edges, read_edge)?;
        let mut outputs = each(text, &file.outputs, read_output)?;
        if let Some(renamed) = &mut renamed {
            renamed.slots(&mut edges, &mut outputs);
        }
        Ok(Self {
            imports,
            nodes,
            edges,
            outputs,
            notes: renamed.map(|renamed| renamed.notes).unwrap_or_default(),
        })
    }
}

/// A graph file of the library's own nodes.
impl core::str::FromStr for Graph {
    type Err = GraphError;

    fn from_str(text: &str) -> Result<Self, GraphError> {
        Self::parse(text, &NodeRegistry::new())
    }
}

fn each<T>(
    text: &str,
    values: &[&RawValue],
    mut one: impl FnMut(&str, &str, Position) -> Result<T, GraphError>,
) -> Result<Vec<T>, GraphError> {
    let (mut position, mut offset) = (Position::START, 0);
    values
        .iter()
        .map(|raw| {
            let begin = offset_in(text, raw.get());
            position = position.after(text.as_bytes().get(offset..begin).unwrap_or_default());
            offset = begin;
            one(text, raw.get(), position)
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

fn read_import(text: &str, raw: &str, position: Position) -> Result<Import, GraphError> {
    let import: FileImport = read(text, raw)?;
    let expected = match (import.texture, import.buffer_size) {
        (Some(_), Some(_)) => {
            return Err(GraphError::new(
                GraphErrorKind::Syntax,
                format!(
                    "import '{}' is given as a texture and as a buffer; keep one of them",
                    import.name
                ),
            )
            .at_position(Some(position)));
        }
        (Some(texture), None) => Some(ResourceDesc::Texture(texture)),
        (None, Some(size)) => Some(ResourceDesc::Buffer { size }),
        (None, None) => None,
    };
    Ok(Import {
        name: import.name,
        expected,
        position: Some(position),
    })
}

fn read_node(
    text: &str,
    raw: &str,
    position: Position,
    registry: &NodeRegistry,
    renamed: Option<&mut Renamed>,
) -> Result<GraphNode, GraphError> {
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
    Ok(GraphNode {
        name: header.name,
        node,
        position: Some(position),
    })
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
    #[derive(Deserialize)]
    struct Named {
        name: String,
    }
    serde_json::from_str(raw)
        .ok()
        .map(|named: Named| named.name)
}

fn unknown_type(type_name: &str, registry: &NodeRegistry) -> GraphError {
    GraphError::new(
        GraphErrorKind::UnknownNodeType,
        format!(
            "there is no node type '{type_name}'; the nearest are {}",
            nearest(type_name, registry.type_names())
        ),
    )
}

fn read_edge(text: &str, raw: &str, position: Position) -> Result<Edge, GraphError> {
    let edge: FileEdge = read(text, raw)?;
    Ok(Edge {
        from: endpoint(&edge.from),
        to: endpoint(&edge.to),
        position: Some(position),
    })
}

fn read_output(text: &str, raw: &str, position: Position) -> Result<Output, GraphError> {
    let output: FileOutput = read(text, raw)?;
    Ok(Output {
        name: output.name,
        from: endpoint(&output.from),
        position: Some(position),
    })
}

fn endpoint(text: &str) -> Endpoint {
    match text.split_once('.') {
        Some((owner, slot)) => Endpoint {
            owner: owner.to_owned(),
            slot: Some(slot.to_owned()),
        },
        None => Endpoint {
            owner: text.to_owned(),
            slot: None,
        },
    }
}
