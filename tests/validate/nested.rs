//! Faults within other statements: each is found, at its place.

use crate::{core, place, refused};

#[test]
fn a_barrier_of_a_fragment_shader_is_found_in_every_statement() {
    for around in [
        "{ HERE }",
        "if x > 0.5 { HERE }",
        "if x > 0.5 { } else { HERE }",
        "switch u32(x) { case 1u: { HERE } default: { } }",
        "loop { HERE if x > 0.5 { break; } }",
        "loop { if x > 0.5 { break; } continuing { HERE } }",
    ] {
        let body = around.replace("HERE", "\nworkgroupBarrier();\n");
        let error = refused(&format!(
            "@fragment fn shade(@location(0) x: f32) {{ {body} }}"
        ));
        let expected = "entry point `shade` uses a barrier, which its stage does not have";
        assert_eq!(error.message, expected, "{around}");
        assert_eq!(place(&error), ("user.wgsl", 2, 1, 16), "{around}");
    }
}

#[test]
fn a_loop_that_is_never_left_is_found_in_what_ends_each_round_of_another() {
    let with = |inner: &str| {
        format!("fn f(x: bool) {{ loop {{ if x {{ break; }} continuing {{\n{inner}\n}} }} }}")
    };
    core(&with("loop { break; }")).unwrap();
    let error = refused(&with("loop { }"));
    assert!(error.message.contains("never left"), "{error}");
    assert_eq!(place(&error).1, 2, "{error}");
}
