//! The linker: what it joins, in which order, where lines come from, and what it refuses.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod compact;
mod edited;
mod imports;
mod joined;
mod names;
mod pruned;

use moment_shadows::{Linked, Location, ShaderError, Source, link};
use proptest::prelude::*;

fn link_user(text: &str) -> Result<Linked, ShaderError> {
    link(
        Source {
            name: "user.wgsl",
            text,
        },
        &[],
    )
}

fn link_with(text: &str, generated: &[(&str, &str)]) -> Result<Linked, ShaderError> {
    let generated: Vec<_> = generated
        .iter()
        .map(|&(name, text)| Source { name, text })
        .collect();
    link(
        Source {
            name: "user.wgsl",
            text,
        },
        &generated,
    )
}

/// Why a shader is not linked: the sentence, and the place that it is about.
fn refused(result: Result<Linked, ShaderError>) -> (String, Location) {
    let ShaderError {
        message, places, ..
    } = result.unwrap_err();
    (message, places.into_iter().next().unwrap())
}

/// The line, column and width of the place.
fn place(at: &Location) -> (u32, u32, u32) {
    (at.line, at.column, at.width)
}

proptest! {
    /// Whatever the text, linking returns, and errors name a place within it.
    #[test]
    fn arbitrary_text_never_panics(
        parts in proptest::collection::vec(
            prop_oneof![
                Just("import "), Just("moment_shadows"), Just("super"), Just("node"), Just("::"), Just("maths"), Just("hankel"),
                Just("{"), Just("}"), Just("hankel_factor"), Just(","), Just(";"), Just("\n"), Just("\r\n"),
                Just("//"), Just("/*"), Just("*/"), Just("fn "), Just("var<"), Just("@if"), Just("é"),
                Just("\u{feff}"), Just("enable "), Just("1.0e5"), Just("\u{2028}"), Just("public "),
            ],
            0..24,
        ),
        noise in any::<String>(),
        at in 0_usize..24,
    ) {
        let mut parts: Vec<&str> = parts;
        parts.insert(at.min(parts.len()), &noise);
        let text = parts.concat();
        for result in [link_user(&text), link_user(&format!("import super::{text}")),
            link_with("import node::m::{a};", &[("m", &text)])] {
            match result {
                Ok(linked) => {
                    let lines = linked.wgsl().lines().count();
                    prop_assert!((1..=lines).all(|line| linked.origin(u32::try_from(line).unwrap())
                        .is_none_or(|(_, line)| line >= 1)));
                }
                Err(error) => prop_assert!(!error.to_string().is_empty()),
            }
        }
    }
}
