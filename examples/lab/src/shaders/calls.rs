//! A shader that calls every function of a module where control flow is not uniform.
//!
//! Modules promise that each function may be called there. WGSL forbids it for functions that take derivatives, but a
//! compiler notices only at a call, and naga not through every path.

use core::fmt::Write;
use std::collections::BTreeMap;

/// `linked`, the module `source` with its closure, and entry points that call each function of `source` in pixels whose
/// place is positive: with a variable that holds zero for each value, and a bound resource for each texture or sampler.
#[must_use]
pub fn calls(source: &str, linked: &str) -> String {
    let mut resources = BTreeMap::new();
    let mut body = String::new();
    for function in functions(source) {
        let _ = writeln!(body, "    if place.x > 0.0 {{");
        let mut arguments = Vec::new();
        for (index, ty) in function.arguments.iter().enumerate() {
            if ty.starts_with("texture_") || ty.starts_with("sampler") {
                let count = resources.len();
                let resource = resources
                    .entry(ty.clone())
                    .or_insert_with(|| format!("called_resource_{count}"));
                arguments.push(resource.clone());
            } else if let Some(pointee) = pointee(ty) {
                let _ = writeln!(body, "        var argument_{index}: {pointee};");
                arguments.push(format!("&argument_{index}"));
            } else {
                let _ = writeln!(body, "        var argument_{index}: {ty};");
                arguments.push(format!("argument_{index}"));
            }
        }
        let result = if function.returns { "_ = " } else { "" };
        let arguments = arguments.join(", ");
        let _ = writeln!(
            body,
            "        {result}{}({arguments});\n    }}",
            function.name
        );
    }
    let mut text = format!(
        "{linked}\n// Calls of every function above where control flow is not uniform.\n\n"
    );
    let mut bindings: Vec<_> = resources.iter().collect();
    bindings.sort_by_key(|(_, name)| *name);
    for (binding, (ty, name)) in bindings.into_iter().enumerate() {
        let _ = writeln!(text, "@group(0) @binding({binding}) var {name}: {ty};");
    }
    let _ = write!(
        text,
        "
struct CalledPlace {{
    @builtin(position) position: vec4f,
    @location(0) place: vec2f,
}}

@vertex
fn call_vertex(@builtin(vertex_index) index: u32) -> CalledPlace {{
    let corner = 4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0;
    return CalledPlace(vec4f(corner, 0.0, 1.0), corner);
}}

@fragment
fn call(@location(0) place: vec2f) -> @location(0) vec4f {{
{body}    return vec4f(place, 0.0, 1.0);
}}
"
    );
    text
}

/// A function's signature.
struct Function<'a> {
    name: &'a str,
    /// The types of its arguments.
    arguments: Vec<String>,
    returns: bool,
}

/// The functions that a module defines. Each begins a line, as the modules' layout asks for.
fn functions(source: &str) -> Vec<Function<'_>> {
    let mut found = Vec::new();
    for (at, _) in source.match_indices("\nfn ") {
        let rest = &source[at + "\nfn ".len()..];
        let (Some(open), Some(close)) = (rest.find('('), rest.find(')')) else {
            continue;
        };
        let body = rest[close..].find('{').unwrap_or_default();
        found.push(Function {
            name: rest[..open].trim(),
            arguments: split(&rest[open + 1..close]),
            returns: rest[close..close + body].contains("->"),
        });
    }
    found
}

/// The types in `name: type, name: type`. A comma between angle brackets belongs to a type.
fn split(arguments: &str) -> Vec<String> {
    let mut depth = 0;
    let parts = arguments.split(|c| {
        match c {
            '<' => depth += 1,
            '>' => depth -= 1,
            _ => {}
        }
        c == ',' && depth == 0
    });
    let ty = |part: &str| Some(part.split_once(':')?.1.trim().to_owned());
    parts.filter_map(ty).collect()
}

/// What a pointer to a variable of a function points to.
fn pointee(ty: &str) -> Option<&str> {
    let inside = ty.strip_prefix("ptr<")?.strip_suffix('>')?;
    Some(inside.split_once(',')?.1.trim())
}
