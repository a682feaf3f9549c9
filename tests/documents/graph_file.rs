//! The page and the schema of graph files are what the code says.

use std::collections::BTreeMap;

use moment_shadows::{MapEncoding, Profile, Storage, Technique};
use moment_shadows_graph::nodes::TranslucentCasters;
use moment_shadows_graph::{
    Capabilities, Connected, Direction, Graph, Node as _, NodeDesc, NodeRegistry, ResourceDesc,
    Rule, SlotResource, TextureDesc, TextureRule,
};
use moment_shadows_lab::catalogue;
use serde_json::{Map, Value};

use crate::kept;

const INTRODUCTION: &str = "# The graph file

A graph file is JSON: what a renderer gives (`imports`), `nodes`, the `edges` between them, and what the renderer takes (`outputs`). Keys
that are not listed here are errors, which name the node, the slot and the place in the file; a `comment` beside them is for people. Order does
not matter.

The [schema](../graph/graph_file.schema.json) lets an editor complete and check a file that names it:
`\"$schema\": \"graph_file.schema.json\"`. This page and the schema are generated from the code; a test holds both.
The schema knows the current version and the library's own nodes; a host that registers nodes of its own extends it.

```json
{
  \"version\": 2,
  \"imports\": [
    { \"name\": \"light_depth\", \"texture\": { \"format\": \"depth32float\", \"size\": [1024, 1024], \"samples\": 4 } },
    { \"name\": \"camera_depth\" }
  ],
  \"nodes\": [
    { \"name\": \"resolve\", \"type\": \"resolve\", \"properties\": { \"technique\": \"hamburger4\", \"storage\": \"best\" } },
    { \"name\": \"blur\", \"type\": \"blur\", \"properties\": { \"kernel\": { \"radius\": 4 } } },
    { \"name\": \"shade\", \"type\": \"shade_hard\" }
  ],
  \"edges\": [
    { \"from\": \"light_depth\", \"to\": \"resolve.depth\" },
    { \"from\": \"resolve.map\", \"to\": \"blur.map\" },
    { \"from\": \"blur.blurred\", \"to\": \"shade.map\" },
    { \"from\": \"camera_depth\", \"to\": \"shade.camera_depth\" }
  ],
  \"outputs\": [{ \"name\": \"shadow_intensity\", \"from\": \"shade.shadow_intensity\" }]
}
```

An import may be given without a description; what the host gives decides in any case. A `Session` takes sizes, layers and samples from
the textures and `regions` from the file. Files of version 1 are read, with a note for each name that has changed.
";

/// A definition of the schema by the name that the page gives it.
const VALUES: [(&str, &str); 13] = [
    ("TextureDesc", "texture"),
    ("Technique", "technique"),
    ("PcfTaps", "taps of `pcf`"),
    ("EsmFiltering", "filtering of `esm`"),
    ("LayerSplits", "splits of `lvsm`"),
    ("Storage", "storage"),
    ("TextureFormat", "format"),
    ("MapEncoding", "encoding"),
    ("SummedAreaTable", "table"),
    ("Show", "what `debug_moments` shows"),
    ("DebugView", "what shading shows"),
    ("AirLight", "light in the air"),
    ("Resolution", "resolution"),
];

fn anchor(title: &str) -> String {
    let letters = title.replace(' ', "-").replace('`', "");
    format!("#{}", letters.to_lowercase())
}

/// Several of what `allowed` says.
fn plural(one: &str) -> String {
    match one.strip_prefix("an ").or(one.strip_prefix("a ")) {
        Some(noun) => format!("{noun}s"),
        None => one.to_owned(),
    }
}

/// A sentence of a table's cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

/// What a schema allows, in words.
fn allowed(schema: &Value) -> String {
    let quoted = |value: &Value| format!("`{value}`");
    if let Some(target) = schema["$ref"].as_str() {
        let name = target.trim_start_matches("#/$defs/");
        let known = VALUES.iter().find(|(known, _)| *known == name);
        return match known {
            Some((_, title)) => format!("[{title}]({})", anchor(title)),
            None => format!("[{}]({})", name.to_lowercase(), anchor(name)),
        };
    }
    if !schema["const"].is_null() {
        return quoted(&schema["const"]);
    }
    if let Some(values) = schema["enum"].as_array() {
        return values.iter().map(quoted).collect::<Vec<_>>().join(", ");
    }
    for several in ["anyOf", "oneOf"] {
        if let Some(schemas) = schema[several]
            .as_array()
            .filter(|_| schema["properties"].is_null())
        {
            let kinds = schemas.iter().filter(|schema| schema["type"] != "null");
            return kinds.map(allowed).collect::<Vec<_>>().join(" or ");
        }
    }
    let kinds: Vec<&str> = match &schema["type"] {
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
        kind => kind.as_str().into_iter().collect(),
    };
    match kinds.iter().find(|kind| **kind != "null").copied() {
        Some("array") => match (&schema["minItems"], schema["maxItems"].as_u64()) {
            (least, Some(most)) if least.as_u64() == Some(most) => {
                format!("{most} {}", plural(&allowed(&schema["items"])))
            }
            _ => format!("a list of {}", plural(&allowed(&schema["items"]))),
        },
        Some("object") => {
            let keys = schema["properties"].as_object().into_iter().flatten();
            let keys: Vec<String> = keys.map(|(key, _)| format!("`{key}`")).collect();
            format!("an object of {}", keys.join(", "))
        }
        Some("integer") => "an integer".to_owned(),
        Some("number") => "a number".to_owned(),
        Some(other) => format!("a {other}"),
        None => "anything".to_owned(),
    }
}

/// A table of an object's properties; objects in it follow with their own.
fn properties(schema: &Value, page: &mut String) {
    let required: Vec<&str> = schema["required"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(Value::as_str)
        .collect();
    let Some(all) = schema["properties"]
        .as_object()
        .filter(|all| !all.is_empty())
    else {
        return;
    };
    page.push_str("\n| property | value | where it is left out | meaning |\n|---|---|---|---|\n");
    rows("", all, &required, page);
}

fn rows(prefix: &str, all: &Map<String, Value>, required: &[&str], page: &mut String) {
    for (name, property) in all {
        let otherwise = match &property["default"] {
            _ if required.contains(&name.as_str()) => "an error".to_owned(),
            Value::Null => String::new(),
            default => format!("`{default}`"),
        };
        let meaning = property["description"].as_str().unwrap_or_default();
        page.push_str(&format!(
            "| `{prefix}{name}` | {} | {otherwise} | {} |\n",
            cell(&allowed(property)),
            cell(meaning)
        ));
        if let Some(inner) = property["properties"].as_object() {
            rows(&format!("{prefix}{name}."), inner, &[], page);
        }
    }
}

/// What can be connected to a slot, or what it becomes.
#[derive(Default)]
struct SlotRow {
    direction: &'static str,
    optional: bool,
    /// In how many descriptions of its node it is.
    count: usize,
    description: String,
    formats: Vec<String>,
    samples: Vec<u32>,
}

fn formats(rule: &TextureRule) -> Vec<String> {
    match &rule.format {
        Rule::Exact(format) => vec![format.to_string()],
        Rule::OneOf(formats) => formats.iter().map(ToString::to_string).collect(),
        Rule::SameAs(slot) => vec![format!("as `{slot}`")],
        Rule::Any => vec!["any".to_owned()],
    }
}

fn slots(descriptions: &[NodeDesc], properties: &Value, page: &mut String) {
    let mut all: Vec<(String, SlotRow)> = Vec::new();
    for slot in descriptions.iter().flat_map(|desc| &desc.slots) {
        let direction = match slot.direction {
            Direction::In => "in",
            Direction::Out => "out",
            Direction::InOut => "in and out",
            Direction::Internal => continue,
        };
        let place = all
            .iter()
            .position(|(name, _)| *name == slot.name)
            .unwrap_or(all.len());
        if place == all.len() {
            all.push((slot.name.clone(), SlotRow::default()));
        }
        let row = &mut all[place].1;
        row.direction = direction;
        row.optional |= slot.optional;
        row.count += 1;
        row.description.clone_from(&slot.description);
        if let SlotResource::Texture(rule) = &slot.resource {
            for format in formats(rule) {
                if !row.formats.contains(&format) {
                    row.formats.push(format);
                }
            }
            if let Rule::OneOf(counts) = &rule.samples {
                row.samples.clone_from(counts);
            }
        }
    }
    page.push_str("\n| slot | | formats | |\n|---|---|---|---|\n");
    for (name, row) in all {
        let needed = match (row.optional, row.count < descriptions.len()) {
            (true, _) => ", can be left out",
            (false, true) if name.starts_with("shadow_intensity_") => {
                ", where there are so many `lights`"
            }
            (false, true) => ", where the technique asks for it",
            (false, false) => "",
        };
        let samples: Vec<String> = row.samples.iter().map(u32::to_string).collect();
        let samples = match samples.as_slice() {
            [] => String::new(),
            counts => format!("; {} samples", counts.join(", ")),
        };
        page.push_str(&format!(
            "| `{name}` | {}{needed} | {}{samples} | {} |\n",
            row.direction,
            match row.formats.len() {
                // A node with this property draws to whatever it says.
                _ if row.direction == "out" && !properties["format"].is_null() => {
                    "what `format` says".to_owned()
                }
                0..8 => row.formats.join(", "),
                _ => "any filterable map".to_owned(),
            },
            row.description
        ));
    }
}

fn parameters(desc: &NodeDesc, page: &mut String) {
    let Some(block) = &desc.parameters else {
        return;
    };
    let each = match &block.each_layer_of {
        Some(slot) => format!(" for each layer of `{slot}`"),
        None => String::new(),
    };
    let elements = match block.elements {
        _ if ["ViewParameters", "MarchScatteringParameters"].contains(&block.name.as_str()) => {
            ", one for each of its `views`"
        }
        1 if block.name != "DepthConversion" => "",
        _ => ", one for each region",
    };
    page.push_str(&format!(
        "\nParameters: `{}`{each}{elements}.\n",
        block.name
    ));
}

fn translucent_casters() -> NodeDesc {
    let map = MapEncoding::new(Technique::Hamburger6, Storage::Float16).unwrap();
    let map = TextureDesc::of_map(map.with_blends(1).unwrap(), [64, 64]);
    let inputs = [("map".to_owned(), ResourceDesc::Texture(map))].into();
    let capabilities = Capabilities::of_profile(Profile::WebgpuCore);
    let connected = Connected::new(&inputs, &capabilities);
    TranslucentCasters {}.describe(&connected).unwrap()
}

fn page() -> String {
    let schema = Graph::schema();
    let mut described: BTreeMap<String, Vec<NodeDesc>> = BTreeMap::new();
    for variant in catalogue::variants().unwrap() {
        let desc = variant.describe().unwrap();
        described.entry(desc.name.clone()).or_default().push(desc);
    }
    // The host draws it: it has no shader, and no place in the catalogue.
    let drawn = described.entry("translucent_casters".to_owned());
    drawn.or_default().push(translucent_casters());
    let mut page = INTRODUCTION.to_owned();
    page.push_str("\n## Imports, edges, outputs\n");
    for (list, name) in [
        ("imports", "FileImport"),
        ("edges", "Edge"),
        ("outputs", "FileOutput"),
    ] {
        page.push_str(&format!("\nEach of the `{list}`:\n"));
        properties(&schema["$defs"][name], &mut page);
    }
    page.push_str("\n## Nodes\n");
    for node in schema["properties"]["nodes"]["items"]["oneOf"]
        .as_array()
        .unwrap()
    {
        let name = node["properties"]["type"]["const"].as_str().unwrap();
        let description = node["description"].as_str().unwrap();
        let (_, description) = description.split_once(": ").unwrap();
        page.push_str(&format!("\n### `{name}`\n\n{description}\n"));
        let descriptions = &described[name];
        slots(
            descriptions,
            &node["properties"]["properties"]["properties"],
            &mut page,
        );
        properties(&node["properties"]["properties"], &mut page);
        parameters(&descriptions[0], &mut page);
    }
    page.push_str("\n## Values\n");
    for (name, title) in VALUES {
        let value = &schema["$defs"][name];
        page.push_str(&format!(
            "\n### {title}\n\n{}\n",
            value["description"].as_str().unwrap_or_default()
        ));
        if value["properties"].is_object() {
            properties(value, &mut page);
            continue;
        }
        page.push_str("\n| value | meaning |\n|---|---|\n");
        let with_settings = value["anyOf"][1]["oneOf"].as_array();
        for one in with_settings.or(value["oneOf"].as_array()).unwrap() {
            choice(one, &mut page);
        }
    }
    page
}

/// A row of what a value can be: a name, or a name with settings.
fn choice(schema: &Value, page: &mut String) {
    let meaning = cell(schema["description"].as_str().unwrap_or_default());
    let names = match (&schema["enum"], schema["properties"].as_object()) {
        (Value::Array(names), _) => names.iter().map(|name| format!("`{name}`")).collect(),
        (_, Some(object)) => object
            .iter()
            .map(|(name, settings)| {
                let keys = settings["properties"].as_object().into_iter().flatten();
                let keys: Vec<String> = keys.map(|(key, _)| format!("`{key}`")).collect();
                match keys.as_slice() {
                    [] => format!("`\"{name}\"` with {}", cell(&allowed(settings))),
                    keys => format!("`\"{name}\"` with {}", keys.join(", ")),
                }
            })
            .collect(),
        _ => vec![format!("`{}`", schema["const"])],
    };
    let settings = schema["properties"].as_object().into_iter().flatten();
    let settings: Vec<String> = settings
        .flat_map(|(_, settings)| settings["properties"].as_object().into_iter().flatten())
        .map(|(key, setting)| {
            format!(
                "`{key}`: {}",
                cell(setting["description"].as_str().unwrap_or_default())
            )
        })
        .collect();
    let settings = settings.join(" ");
    page.push_str(&format!(
        "| {} | {meaning} {settings} |\n",
        names.join(", ")
    ));
}

#[test]
fn the_schema_is_what_the_code_says() {
    let text = serde_json::to_string_pretty(&Graph::schema()).unwrap();
    kept("graph/graph_file.schema.json", &format!("{text}\n"));
}

#[test]
fn the_page_is_what_the_code_says() {
    kept("docs/graph_file.md", &page());
}

#[test]
fn every_node_type_is_in_the_schema() {
    let schema = Graph::schema();
    let nodes = schema["properties"]["nodes"]["items"]["oneOf"]
        .as_array()
        .unwrap();
    let names = nodes
        .iter()
        .map(|node| node["properties"]["type"]["const"].as_str().unwrap());
    let registry = NodeRegistry::new();
    assert!(names.eq(registry.type_names()));
}
