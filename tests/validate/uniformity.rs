//! Where all invocations have to go together: what is known of variables, and what is said.

use moment_shadows::{Rule, ShaderError};

use crate::{core, refused};

fn fragment(statements: &str) -> String {
    format!(
        "@fragment fn main(@location(0) x: f32) -> @location(0) vec4f {{\n{statements}\nreturn vec4f(x); }}\n"
    )
}

fn branching_by(statements: &str) -> String {
    fragment(&format!("{statements} > 0.5 {{ return vec4f(dpdx(x)); }}"))
}

fn is_of_uniformity(error: &ShaderError) -> bool {
    error.rule == Rule::Uniformity
}

#[test]
fn a_part_that_is_stored_leaves_the_others_as_they_were() {
    for statements in [
        "var v: vec2f; v.x = x; v.y = 1.0; if v.x",
        "var v: array<f32, 2>; v[0] = x; v[1] = 1.0; if v[0]",
    ] {
        let error = refused(&branching_by(statements));
        assert!(is_of_uniformity(&error), "{statements}: {error}");
    }
    for statements in [
        "var v: vec2f; v.x = 2.0; v.y = 1.0; if v.x",
        "var v: vec2f; v.x = x; v = vec2f(1.0); if v.x",
    ] {
        core(&branching_by(statements)).unwrap();
    }
}

#[test]
fn derivatives_are_called_by_their_names() {
    for axis in ["dpdx", "dpdy", "fwidth"] {
        for control in ["", "Coarse", "Fine"] {
            let name = format!("{axis}{control}");
            let error = refused(&fragment(&format!(
                "if x > 0.5 {{ return vec4f({name}(x)); }}"
            )));
            assert!(is_of_uniformity(&error), "{error}");
            let start = format!("`{name}` must be called by all");
            assert!(error.message.starts_with(&start), "{error}");
        }
    }
}
