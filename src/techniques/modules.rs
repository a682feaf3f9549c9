//! The modules that a technique supplies to a node's shader, made of the pieces of its row by one template each.
//!
//! They are imported as `node::map_encoding`, `node::map_filtering` and `node::technique`, and import the row's constants from
//! `node::specialization`.

use core::fmt::Write;
use std::collections::BTreeSet;

use super::row::Row;
use crate::link::ITEMS;

/// What the pieces of a row can use besides the library and the row's own constants: the module and the item.
const NODE_ITEMS: [(&str, &str); 13] = [
    ("map_texel", "map_texel"),
    ("moments_lookup", "moments_map"),
    ("specialization", "BLENDS"),
    ("specialization", "PLANES"),
    ("specialization", "STORAGE"),
    ("specialization", "TABLE_ERROR"),
    ("technique_layers", "technique_layers"),
    ("technique_map", "comparison_sampler"),
    ("technique_map", "depth_map"),
    ("technique_map", "table_sums"),
    ("technique_receiver", "TechniqueReceiver"),
    ("technique_soft", "soft_receiver"),
    ("technique_soft", "soft_table"),
];

/// The text of a module with these functions, and imports of all that they name.
fn module(row: &Row, functions: &str) -> String {
    let words = functions.split(|c: char| !c.is_alphanumeric() && c != '_');
    let words: BTreeSet<&str> = words.collect();
    let constants = row.constants.iter();
    let constants = constants.map(|constant| ("specialization", constant.name));
    let of_node = NODE_ITEMS.into_iter().chain(constants);
    let of_library = ITEMS.iter().map(|item| ("moment_shadows", *item));
    let mut text = String::new();
    for (root, (module, item)) in of_library.chain(of_node.map(|item| ("node", item))) {
        if words.contains(item) {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "import {root}::{module}::{{{item}}};");
        }
    }
    if encodes_plane(functions) {
        text.push_str("\n// The plane that is made.\noverride PLANE: u32;\n");
    }
    text.push_str(functions);
    text
}

fn encodes_plane(text: &str) -> bool {
    text.contains("PLANE,") || text.contains("PLANE)")
}

impl Row {
    /// Whether the encoding has an `override` constant `PLANE`, the plane that it makes.
    #[must_use]
    pub fn encodes_planes(&self) -> bool {
        self.encoding
            .is_some_and(|it| encodes_plane(it.channels) || encodes_plane(it.texel))
    }

    /// How a map is encoded: `encoding_channels` and `encoding_texel`, the module `map_encoding`. Empty where the plain depth map is read.
    #[must_use]
    pub fn map_encoding(&self) -> String {
        self.encoding.map_or_else(String::new, |it| {
            let what = "What is averaged for a moment depth.";
            let channels = function(what, "encoding_channels(z: f32)", it.channels);
            let what = "The texel for the mean.";
            let texel = function(what, "encoding_texel(mean: vec4f)", it.texel);
            module(self, &(channels + &texel))
        })
    }

    /// How texels are averaged: `filtering_value` and `filtering_texel`, the module `map_filtering`. Empty where the plain depth map is read.
    #[must_use]
    pub fn map_filtering(&self) -> String {
        self.encoding.map_or_else(String::new, |it| {
            let what = "What a filter averages of a texel.";
            let value = function(what, "filtering_value(texel: vec4f)", it.filter_value);
            let what = "The texel for such an average.";
            let texel = function(what, "filtering_texel(value: vec4f)", it.filter_texel);
            module(self, &(value + &texel))
        })
    }

    /// How a fragment is shaded: `technique_shadow_intensity`, the module `technique`.
    #[must_use]
    pub fn technique(&self) -> String {
        intensity(self, self.evaluation)
    }

    /// The same from a map that `BLENDS` translucent casters were blended into, one after the other: another module `technique`. None
    /// where none can be.
    #[must_use]
    pub fn blended_technique(&self) -> Option<String> {
        self.blended.map(|it| intensity(self, it.evaluation))
    }

    /// The same from a map whose texels are rounded inwards: another module `technique`. None where none are.
    #[must_use]
    pub fn rounded_inwards_technique(&self) -> Option<String> {
        self.rounded_inwards.map(|it| intensity(self, it))
    }

    /// How a fragment is shaded softly from the summed-area table of the map: another module `technique`. None where the technique has no
    /// soft shadows.
    #[must_use]
    pub fn soft_technique(&self) -> Option<String> {
        self.soft.map(|soft| intensity(self, soft))
    }

    /// What blocks a fragment's light: `technique_blockers`, its share, its mean moment depth and half the width in texels of what is then filtered, the module `technique_blockers`. None where
    /// nothing is searched for.
    #[must_use]
    pub fn technique_blockers(&self) -> Option<String> {
        let what = "Share and mean depth of blockers, and half the filter's width,";
        self.blockers
            .map(|it| of_receiver(self, what, "technique_blockers", "vec3f", it))
    }

    /// The last layer that shades a fragment: `technique_layer`, the module `technique_layer`. None without layers.
    #[must_use]
    pub fn technique_layer(&self) -> Option<String> {
        let what = "The last layer that shades a fragment,";
        self.layer
            .map(|it| of_receiver(self, what, "technique_layer", "u32", it))
    }

    /// Names and values of the constants that these modules import, WGSL expressions.
    pub fn constants(&self) -> impl Iterator<Item = (&'static str, &str)> {
        self.constants
            .iter()
            .map(|constant| (constant.name, constant.value.as_str()))
    }
}

/// A function that gives a vec4f.
fn function(what: &str, head: &str, value: &str) -> String {
    format!("\n// {what}\nfn {head} -> vec4f {{\n    return {value};\n}}\n")
}

/// `technique_shadow_intensity` by a piece of a row.
fn intensity(row: &Row, body: &str) -> String {
    of_receiver(
        row,
        "Shadow intensity",
        "technique_shadow_intensity",
        "f32",
        body,
    )
}

/// A module with one function of a receiver.
fn of_receiver(row: &Row, what: &str, name: &str, gives: &str, body: &str) -> String {
    let plane = if row.reads_depth() {
        "let plane = receiver_plane_through(receiver.uv, receiver.depth, receiver.gradient, receiver.steepest, \
         depth_of_light(receiver.conversion));\n    "
    } else {
        ""
    };
    let functions = format!(
        "
// {what} by the technique '{}'.
fn {name}(receiver: TechniqueReceiver) -> {gives} {{
    {plane}{body}
}}
",
        row.name
    );
    module(row, &functions)
}
