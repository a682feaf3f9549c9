//! Operators that stand beside each other: what WGSL takes, and what it asks parentheses for.

use crate::{core, place, refused, validate_user};
use moment_shadows::Profile;

fn with(statements: &str) -> String {
    format!(
        "fn g(a: u32, b: bool) -> u32 {{ return a + u32(b); }}\n\
         @fragment fn main(@location(0) @interpolate(flat) i: u32, @location(1) f: f32) -> @location(0) vec4f {{\n\
         var v: vec4<f32>; var u = i; var b = f < 0.5; var m: mat2x2<f32>; var n: array<vec2<u32>, (1 << 2)>;\n\
         {statements}\n\
         return v + f32(u) + f32(b) + m[0].xyxy + f32(n[0].x); }}\n"
    )
}

#[test]
fn what_has_an_order_is_taken() {
    for statements in [
        "u = i & 3u & u;",
        "u = (i << 2u) | 3u;",
        "u = i | (u & 1u) | 2u;",
        "u = i << (2u + u);",
        "u = ~i << 2u;",
        "u += i - u * 2u / 3u % 5u;",
        "u = u - (i << 1u) * 2u;",
        "b = f < 0.5 && i > 3u && !b;",
        "b = f + 1.0 < 0.5 * f || i != 3u || b == true;",
        "b = (i << 2u) < u;",
        "b = i << 2u < u;",
        "b = (f < 0.5) == true;",
        "b = (b && i < 2u) || f >= 0.5;",
        "u = select(i & 3u, u, f < 0.5 && b);",
        "u = g(i, f < 0.5);",
        "for (var k = 0u; k < 4u; k++) { u |= k & 1u; u <<= 1u; }",
        "if f < 0.5 { u = i; } else if -f > 0.5 { u &= i; }",
        "while u < 3u { u++; }",
        "switch i { case 1u, 2u: { u = 1u; } default: { u = i; } }",
        "let p = &u; *p = i * *p; u = i - -(-2) as_u32;",
        "v = vec4<f32>(f, -f, f * -1.0, f - 1.0); m = mat2x2<f32>(v.xy, v.zw);",
        "n[i & 3u] = vec2<u32>(i, u); u = n[u & 1u].y & 7u;",
        "let a = array<array<u32, 2>, 2>(array<u32, 2>(1u, 2u), array<u32, 2>(3u, 4u)); u = a[0][1] | 1u;",
        "u = bitcast<u32>(f) & 0x7fffffffu;",
        "b = bitcast<u32>(f) > 3u == false;",
    ] {
        let text = with(&statements.replace(" - -(-2) as_u32", " - u32(-(-2))"));
        let found = core(&text);
        // The last is a chain after a template's `>`: it has none.
        match statements.starts_with("b = bitcast") {
            false => drop(found.unwrap_or_else(|error| panic!("{statements}: {error}"))),
            true => drop(found.unwrap_err()),
        }
    }
}

#[test]
fn what_has_no_order_is_refused() {
    for (statement, first, second) in [
        ("u = i << 2u | 3u;", "<<", "|"),
        ("u = i & u | 1u;", "&", "|"),
        ("u = i ^ u & 1u;", "^", "&"),
        ("u = i & u + 1u;", "&", "+"),
        ("u = i * 2u & u;", "*", "&"),
        ("u = i << 2u + u;", "<<", "+"),
        ("u = i + 1u >> 2u;", "+", ">>"),
        ("u = i << 1u << 2u;", "<<", "<<"),
        ("b = f < 0.5 == true;", "<", "=="),
        ("b = f < 0.5 && b || i > 1u;", "&&", "||"),
        ("b = b || f < 0.5 && i > 1u;", "||", "&&"),
        ("n[i << 1u | 1u].x = 1u;", "<<", "|"),
        ("u = g(i | u & 1u, b);", "|", "&"),
        ("if f < 0.5 && b || i > 1u { u = 1u; }", "&&", "||"),
    ] {
        let text = with(statement);
        let error = refused(&text);
        let expected = format!("`{first}` and `{second}` stand in one expression");
        assert!(error.message.starts_with(&expected), "{statement}: {error}");
        assert_eq!(place(&error).1, 4, "{statement}: {error}");
        assert_eq!(error.places.len(), 2, "{statement}");
        // naga takes them, and so do native devices.
        validate_user(&text, Profile::Native).unwrap();
    }
}
