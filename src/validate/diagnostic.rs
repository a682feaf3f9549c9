//! What the WGSL compiler says about a shader, at the places before linking.

use core::ops::Range;
use std::error::Error;

use naga::common::wgsl::TryToWgsl;
use naga::front::wgsl::ParseError;
use naga::valid::ValidationError;

use crate::link::file::definitions;
use crate::link::tokens::{Token, tokens};
use crate::{Linked, Location, ShaderError};

/// The bytes `range` of the linked text. `None` for text that comes from no file.
fn place(linked: &Linked, range: Option<Range<usize>>, label: &str) -> Option<Location> {
    Some(linked.location(range?)?.labelled(label))
}

pub(super) fn of_parse_error(linked: &Linked, error: &ParseError) -> ShaderError {
    let labels = error.labels();
    ShaderError {
        message: error.message().to_owned(),
        places: labels
            .filter_map(|(span, text)| place(linked, span.to_range(), text))
            .collect(),
        notes: error.notes().map(str::to_owned).collect(),
    }
}

pub(super) fn of_validation_error(
    linked: &Linked,
    module: &naga::Module,
    error: &naga::WithSpan<ValidationError>,
) -> ShaderError {
    let mut places: Vec<_> = error
        .spans()
        .filter_map(|(span, text)| {
            // Names of naga's types and handles say nothing to the author of a shader.
            let text = if text.starts_with("naga::") { "" } else { text };
            place(linked, span.to_range(), text)
        })
        .collect();
    // naga goes from the outside in.
    places.reverse();
    let (message, culprit) = headline(module, error.as_inner());
    if places.is_empty() {
        places.extend(culprit.and_then(|word| find(linked, word)));
    }
    let first: Option<&dyn Error> = error.as_inner().source();
    let causes = core::iter::successors(first, |&cause| cause.source());
    ShaderError {
        message,
        places,
        notes: causes.map(ToString::to_string).collect(),
    }
}

/// What is not valid, and the word by which it is found in the text where naga gives no place.
fn headline<'a>(module: &naga::Module, error: &'a ValidationError) -> (String, Option<&'a str>) {
    use ValidationError as E;
    let of = |kind: &str, name: &'a str| (format!("{kind} `{name}` is not valid"), Some(name));
    match error {
        E::Function { name, .. } => of("function", name),
        E::EntryPoint { name, .. } => of("entry point", name),
        E::GlobalVariable { name, .. } => of("variable", name),
        E::Constant { name, .. } => of("constant", name),
        E::Override { name, .. } => of("override", name),
        E::Type { name, .. } if !name.is_empty() => of("type", name),
        E::Type { handle, .. } => {
            let ty = module.types.get_handle(*handle).ok();
            let scalar = ty.and_then(|ty| ty.inner.scalar());
            match scalar.and_then(TryToWgsl::try_to_wgsl) {
                Some(name) => of("type", name),
                None => ("a type is not valid".to_owned(), None),
            }
        }
        E::InvalidHandle(_)
        | E::Layouter(_)
        | E::ConstExpression { .. }
        | E::ArraySizeError { .. }
        | E::Corrupted => (error.to_string(), None),
    }
}

/// The definition of `word`, or else its first use.
pub(super) fn find(linked: &Linked, word: &str) -> Option<Location> {
    let tokens = tokens(linked.wgsl()).unwrap_or_default();
    let defined = definitions(&tokens);
    let named = |token: &&Token<'_>| token.is_word(word);
    let token = defined
        .iter()
        .find(named)
        .or_else(|| tokens.iter().find(named))?;
    linked.location(token.range())
}
