//! The shader that an exported file is made of: a technique's row as functions without bindings.

use core::fmt::Write;
use std::collections::BTreeSet;

use crate::link::ITEMS;
use crate::techniques::Row;
use crate::{MapEncoding, Source, ValueError, link};

/// The functions that every exported file has: those of the row, and what comes before and behind them.
pub(super) const COMMON: [&str; 7] = [
    "encoding_channels",
    "encoding_texel",
    "filtering_value",
    "filtering_texel",
    "technique_shadow_intensity",
    "depth_to_moment_depth",
    "leak_reduction_apply",
];

/// The text after linking, with a blank line below each comment that names a file.
pub(super) fn linked(encoding: &MapEncoding) -> Result<String, ValueError> {
    let row = encoding.technique().row();
    let text = text(encoding, &row);
    let name = format!("{}, stored as {}", encoding.technique(), encoding.storage());
    let source = Source {
        name: &name,
        text: &text,
    };
    let linked = link(source, &[]).map_err(|error| super::broken(&error))?;
    let mut spaced = String::new();
    for (number, line) in (1..).zip(linked.wgsl().lines()) {
        spaced.push_str(line);
        let is_heading = line.starts_with("//") && linked.origin(number).is_none();
        spaced.push_str(if is_heading { "\n\n" } else { "\n" });
    }
    Ok(spaced)
}

fn text(encoding: &MapEncoding, row: &Row) -> String {
    let code = constants(encoding, row) + &functions(row) + &kept(encoding, row);
    let words = code.split(|c: char| !c.is_alphanumeric() && c != '_');
    let words: BTreeSet<&str> = words.collect();
    let mut text = String::new();
    for (module, item) in ITEMS.iter().filter(|(_, item)| words.contains(item)) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "import moment_shadows::{module}::{{{item}}};");
    }
    text + &code
}

fn constants(encoding: &MapEncoding, row: &Row) -> String {
    let storage = encoding.storage().name().to_uppercase();
    let mut text = format!(
        "
// How texels are stored.
const STORAGE: u32 = STORAGE_{storage};

// The texture layers that a layer of the map consists of.
const PLANES: u32 = {}u;
",
        row.planes
    );
    for (name, value) in row.constants() {
        let _ = writeln!(
            text,
            "\n// A setting of the technique.\nconst {name} = {value};"
        );
    }
    text
}

fn functions(row: &Row) -> String {
    let Some(encoding) = row.encoding else {
        return String::new();
    };
    let mut text = String::new();
    let mut function = |what: &str, name: &str, argument: &str, value: &str| {
        let is_of_plane = value.contains("PLANE");
        let plane = if is_of_plane { ", plane: u32" } else { "" };
        let value = value.replace("PLANE", "plane").replace("(0u)", "()");
        let _ = writeln!(
            text,
            "\n{what}\nfn {name}({argument}{plane}) -> vec4f {{\n    return {value};\n}}"
        );
    };
    let of_plane = if row.planes > 1 {
        ", in a plane of the map"
    } else {
        ""
    };
    function(
        &format!(
            "// What is averaged for a moment depth z in [-1, 1]{of_plane}: over the samples of a texel, say."
        ),
        "encoding_channels",
        "z: f32",
        encoding.channels,
    );
    function(
        "// The texel to write for the average of `encoding_channels`.",
        "encoding_texel",
        "mean: vec4f",
        encoding.texel,
    );
    function(
        "// What a filter averages of a texel, with weights that are not negative and sum to one.",
        "filtering_value",
        "texel: vec4f",
        encoding.filter_value,
    );
    function(
        "// The texel to write for an average of `filtering_value`.",
        "filtering_texel",
        "value: vec4f",
        encoding.filter_texel,
    );
    text + &layers(row) + &intensity(row)
}

/// Where the layers of a layered variance shadow map lie.
fn layers(row: &Row) -> String {
    let has_layers = row.constants().any(|(name, _)| name == "LAYER_SPLITS_LOW");
    let text = "
// The layers of the map.
fn technique_layers() -> LayeredVarianceLayers {
    return LayeredVarianceLayers(array<vec4f, 2>(LAYER_SPLITS_LOW, LAYER_SPLITS_HIGH), LAYERS, LAYER_OVERLAP, vec2f(0.0));
}
";
    if has_layers {
        text.to_owned()
    } else {
        String::new()
    }
}

/// Shadow intensity of a fragment, of what a lookup gives.
fn intensity(row: &Row) -> String {
    let body = row.exported.unwrap_or(row.evaluation);
    let body = body.replace("receiver.fragment_depth", "fragment_depth");
    let body = body.replace("technique_layers(receiver.layer)", "technique_layers()");
    let (what, argument, copy) = if row.planes == 1 {
        ("a value that is", "value: vec4f".to_owned(), "")
    } else {
        let argument = format!("values: array<vec4f, {}>", row.planes);
        // What is looked up by an index has to be a variable.
        (
            "values, one of each plane, each",
            argument,
            "    var looked_up = values;\n",
        )
    };
    let mut rest = body.as_str();
    let mut body = String::new();
    while let Some((before, after)) = rest.split_once("map_texel(receiver, ") {
        let (plane, after) = after.split_once(')').unwrap_or((after, ""));
        body.push_str(before);
        match row.planes {
            1 => body.push_str("value"),
            _ => body.push_str(&format!("looked_up[{plane}]")),
        }
        rest = after;
    }
    body.push_str(rest);
    format!(
        "
// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` (moment depth, less a bias against
// self-shadowing) for {what} an average of `filtering_value` at the place in the map.
fn technique_shadow_intensity({argument}, fragment_depth: f32) -> f32 {{
{copy}    {body}
}}
"
    )
}

/// A function that names what is kept besides; nothing reaches it, so it goes.
fn kept(encoding: &MapEncoding, row: &Row) -> String {
    let packing = encoding.storage().packing();
    let names = COMMON.iter().skip(5).chain(row.functions).chain(packing);
    let names: Vec<_> = names.map(|name| format!("    {name};\n")).collect();
    format!("\nfn keeps() {{\n{}}}\n", names.concat())
}
