//! What core WebGPU has of things per entry point: each limit reached, and passed by one.

use std::fmt::Write as _;

use crate::{core, place, refused, validate_user};
use moment_shadows::Profile;

/// So many variables of a type, and a fragment shader that uses each by an expression of its name.
fn using(count: usize, declaration: &str, used: &str) -> String {
    let mut text = String::new();
    let mut body = String::new();
    for index in 0..count {
        let named = |text: &str| text.replace("NAME", &format!("v{index}"));
        let _ = writeln!(
            text,
            "@group({}) @binding({}) {};",
            index / 8,
            index % 8,
            named(declaration)
        );
        let _ = writeln!(body, "    c += {};", named(used));
    }
    format!(
        "{text}@fragment fn main() -> @location(0) vec4f {{\n    var c = vec4f(0.0);\n{body}    return c;\n}}\n"
    )
}

#[test]
fn a_stage_has_so_many_resources() {
    let sampler = "@group(3) @binding(100) var t: texture_2d<f32>;\n";
    for (most, declaration, used, head) in [
        (12, "var<uniform> NAME: vec4f", "NAME", ""),
        (8, "var<storage, read> NAME: vec4f", "NAME", ""),
        (
            16,
            "var NAME: texture_2d<f32>",
            "textureLoad(NAME, vec2u(0u), 0)",
            "",
        ),
        (
            16,
            "var NAME: sampler",
            "textureSampleLevel(t, NAME, vec2f(0.5), 0.0)",
            sampler,
        ),
        (
            4,
            "var NAME: texture_storage_2d<rgba8unorm, write>",
            "vec4f(vec2f(textureDimensions(NAME)), 0.0, 0.0)",
            "",
        ),
    ] {
        core(&format!("{head}{}", using(most, declaration, used))).unwrap();
        let text = format!("{head}{}", using(most + 1, declaration, used));
        let error = refused(&text);
        let expected = format!("uses {} ", most + 1);
        assert!(
            error.message.contains(&expected) && error.message.contains("`main`"),
            "{error}"
        );
        // The first one that is too many.
        let line = head.lines().count() + most + 1;
        assert_eq!(place(&error).1 as usize, line, "{error}");
        validate_user(&text, Profile::Native).unwrap();
        // What no entry point uses does not count.
        let unused = text.replacen(
            &format!("    c += {};\n", used.replace("NAME", "v0")),
            "",
            1,
        );
        core(&unused).unwrap();
    }
}

#[test]
fn bind_groups_and_bindings_have_a_last_number() {
    let at = |group: u32, binding: u32| {
        format!(
            "@group({group}) @binding({binding}) var<uniform> u: vec4f;\n@fragment fn main() -> @location(0) vec4f {{ return u; }}\n"
        )
    };
    core(&at(3, 999)).unwrap();
    assert!(refused(&at(4, 0)).message.contains("groups 0 to 3"));
    assert!(refused(&at(0, 1000)).message.contains("bindings 0 to 999"));
}

#[test]
fn workgroups_are_so_large() {
    let of = |size: &str| format!("@compute @workgroup_size({size}) fn main() {{}}\n");
    for size in ["256", "16, 16", "1, 256", "2, 2, 64"] {
        core(&of(size)).unwrap();
    }
    for size in ["257", "16, 17", "1, 1, 65", "1024"] {
        assert!(refused(&of(size)).message.contains("workgroup"), "{size}");
    }
    // An override is the host's to choose; its default is what a pipeline has that does not.
    let of_override = |of: &str| {
        format!("override side: u32{of};\n@compute @workgroup_size(side) fn main() {{}}\n")
    };
    core(&of_override("")).unwrap();
    core(&of_override(" = 256u")).unwrap();
    assert!(
        refused(&of_override(" = 512u"))
            .message
            .contains("512 x 1 x 1")
    );
    let memory = |length: u32| {
        format!(
            "var<workgroup> a: array<vec4f, {length}>;\n@group(0) @binding(0) var<storage, read_write> b: vec4f;\n\
             @compute @workgroup_size(1) fn main(@builtin(local_invocation_index) i: u32) {{ b = a[i]; }}\n"
        )
    };
    core(&memory(1024)).unwrap();
    assert!(
        refused(&memory(1025))
            .message
            .contains("16400 bytes of workgroup memory")
    );
}

#[test]
fn locations_have_a_last_number() {
    let targets = |count: u32| {
        let members = (0..count).map(|index| format!("@location({index}) c{index}: vec4f,"));
        let members: String = members.collect();
        format!(
            "struct Out {{ {members} }}\n@fragment fn main() -> Out {{ var o: Out; return o; }}\n"
        )
    };
    core(&targets(8)).unwrap();
    assert!(refused(&targets(9)).message.contains("colour targets"));
    let varying = |location: u32, front: &str| {
        let all = (0..=location).map(|index| format!("@location({index}) v{index}: f32, "));
        let all: String = all.collect();
        format!("@fragment fn main({all}{front}) -> @location(0) vec4f {{ return vec4f(v0); }}\n")
    };
    core(&varying(15, "")).unwrap();
    assert!(refused(&varying(16, "")).message.contains("location 16"));
    core(&varying(14, "@builtin(front_facing) front: bool")).unwrap();
    let error = refused(&varying(15, "@builtin(front_facing) front: bool"));
    assert!(error.message.contains("uses 17 inputs"), "{error}");
    let attribute = |location: u32| {
        format!(
            "@vertex fn main(@location({location}) a: vec4f) -> @builtin(position) vec4f {{ return a; }}\n"
        )
    };
    core(&attribute(15)).unwrap();
    assert!(
        refused(&attribute(16))
            .message
            .contains("vertex attributes")
    );
}

#[test]
fn vertex_shaders_write_nothing() {
    let of = |access: &str| {
        format!(
            "@group(0) @binding(0) var<storage, {access}> b: array<f32>;\n\
             @vertex fn main() -> @builtin(position) vec4f {{ return vec4f(b[0]); }}\n"
        )
    };
    core(&of("read")).unwrap();
    let error = refused(&of("read_write"));
    assert!(error.message.contains("vertex shader"), "{error}");
    assert_eq!(place(&error), ("user.wgsl", 1, 23, 39), "{error}");
    validate_user(&of("read_write"), Profile::Native).unwrap();
}
