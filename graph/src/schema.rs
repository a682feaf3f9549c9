//! The JSON schemas of graph files and of plans.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Value, json};

use crate::Plan;
use crate::graph::{Edge, FileImport, FileOutput, Graph, VERSION};
use crate::nodes::{
    Blur, CompositeScattering, ContactShadows, DebugMoments, Downsample, FitRange,
    IntegrateScattering, MarchScattering, PlaceLayers, RectifyMoments, Resolve, ShadeHard,
    ShadeSoft, SummedAreaTable, TranslucentCasters, UpsampleScattering,
};

impl Graph {
    /// The JSON schema of graph files of the current version with the library's own nodes (JSON Schema 2020-12). A host's own node
    /// types are not in it.
    #[must_use]
    pub fn schema() -> Value {
        let mut settings = SchemaSettings::draft2020_12();
        settings.meta_schema = None;
        let generator = &mut settings.into_generator();
        let nodes = [
            node::<Blur>(generator, "blur"),
            node::<CompositeScattering>(generator, "composite_scattering"),
            node::<ContactShadows>(generator, "contact_shadows"),
            node::<DebugMoments>(generator, "debug_moments"),
            node::<Downsample>(generator, "downsample"),
            node::<FitRange>(generator, "fit_range"),
            node::<IntegrateScattering>(generator, "integrate_scattering"),
            node::<MarchScattering>(generator, "march_scattering"),
            node::<PlaceLayers>(generator, "place_layers"),
            node::<RectifyMoments>(generator, "rectify_moments"),
            node::<Resolve>(generator, "resolve"),
            node::<ShadeHard>(generator, "shade_hard"),
            node::<ShadeSoft>(generator, "shade_soft"),
            node::<SummedAreaTable>(generator, "summed_area_table"),
            node::<TranslucentCasters>(generator, "translucent_casters"),
            node::<UpsampleScattering>(generator, "upsample_scattering"),
        ];
        let [imports, edges, outputs] = [
            generator.subschema_for::<FileImport>(),
            generator.subschema_for::<Edge>(),
            generator.subschema_for::<FileOutput>(),
        ];
        let list = |items: Value| json!({ "type": "array", "items": items });
        let mut schema = json!({
            "$schema": "https://json-schema.org/draft/2020-12/schema",
            "title": "A graph of moment-shadows",
            "type": "object",
            "properties": {
                "$schema": { "description": "Where this schema is, for editors.", "type": "string" },
                "comment": { "description": "For people: why the graph is as it is.", "type": "string" },
                "version": { "description": "The version of the format.", "const": VERSION },
                "imports": list(imports.to_value()),
                "nodes": list(json!({ "oneOf": nodes })),
                "edges": list(edges.to_value()),
                "outputs": list(outputs.to_value()),
            },
            "required": ["version", "imports", "nodes", "edges", "outputs"],
            "additionalProperties": false,
            "$defs": generator.take_definitions(true),
        });
        plain(&mut schema);
        schema
    }
}

impl Plan {
    /// The JSON schema of plans of this version (JSON Schema 2020-12).
    #[must_use]
    pub fn schema() -> Value {
        let generator = SchemaSettings::draft2020_12().into_generator();
        let mut schema = generator.into_root_schema_for::<Plan>().to_value();
        schema["title"] = "A plan of moment-shadows".into();
        schema["properties"]["version"] =
            json!({ "description": "The version of the format.", "const": Plan::VERSION });
        plain(&mut schema);
        schema
    }
}

/// A node of a type, with its properties, which have to be given where one of them has to be.
fn node<N: JsonSchema>(generator: &mut SchemaGenerator, name: &str) -> Value {
    let properties: Schema = N::json_schema(generator);
    let mut required = vec!["name", "type"];
    if properties.get("required").is_some() {
        required.push("properties");
    }
    json!({
        "type": "object",
        "description": properties.get("description"),
        "properties": {
            "name": { "description": "The node's name, which nothing else has.", "type": "string" },
            "type": { "const": name },
            "properties": properties,
        },
        "required": required,
        "additionalProperties": false,
    })
}

/// Descriptions are for readers of files: without links to Rust, and without tables.
fn plain(schema: &mut Value) {
    match schema {
        Value::Object(entries) => {
            // An option that is left out.
            if entries.get("default").is_some_and(Value::is_null) {
                entries.remove("default");
            }
            for (key, value) in entries {
                if let (Value::String(text), "description") = (&mut *value, key.as_str()) {
                    *text = prose(text);
                }
                plain(value);
            }
        }
        Value::Array(items) => items.iter_mut().for_each(plain),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

/// The paragraphs of a comment that are no tables, with what links are called in place of them.
fn prose(comment: &str) -> String {
    let paragraphs = comment.split("\n\n");
    let paragraphs = paragraphs.filter(|paragraph| !paragraph.contains("|---|"));
    let text = paragraphs.collect::<Vec<_>>().join(" ").replace('\n', " ");
    let mut parts = text.split("[`");
    let mut prose = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once("`]").unwrap_or((part, ""));
        // What a link leads to may follow.
        let rest = match rest.strip_prefix('(').and_then(|rest| rest.split_once(')')) {
            Some((_, rest)) => rest,
            None => rest,
        };
        let last = name.rsplit("::").next().unwrap_or(name);
        // Modules of nodes are siblings.
        let last = match name.starts_with("super::") {
            true => in_snake_case(last),
            false => last.to_owned(),
        };
        prose += &format!("`{last}`{rest}");
    }
    prose
}

/// The name of a node's type in files.
fn in_snake_case(name: &str) -> String {
    let mut file_name = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !file_name.is_empty() {
            file_name.push('_');
        }
        file_name.extend(letter.to_lowercase());
    }
    file_name
}
