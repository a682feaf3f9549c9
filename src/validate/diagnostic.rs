//! What the WGSL compiler says about a shader, at the places before linking.

use core::ops::Range;

use naga::Span;
use naga::front::wgsl::ParseError;
use naga::valid::ValidationError;

use super::compiler::{Compiler, Fault};
use super::features::Features;
use super::words::Words;
use crate::link::file::definitions;
use crate::link::tokens::{Token, tokens};
use crate::{Linked, Location, Rule, ShaderError};

/// The bytes `range` of the linked text. `None` for text that comes from no file.
fn place(linked: &Linked, range: Option<Range<usize>>, label: &str) -> Option<Location> {
    Some(linked.location(range?)?.labelled(label))
}

pub(super) fn of_parse_error(compiler: &Compiler<'_>, error: &ParseError) -> Box<Fault> {
    let linked = compiler.linked;
    let labels = error.labels();
    let place_in_text = error.labels().next().and_then(|(span, _)| span.to_range());
    let not_computed = |note: &str| note.ends_with("Subexpression(s) are not constant");
    let mut error = ShaderError {
        rule: if error.notes().any(not_computed) {
            Rule::Unsupported
        } else {
            rule_of(compiler, error.message(), place_in_text.clone())
        },
        message: plain(error.message()),
        places: labels
            .filter_map(|(span, text)| place(linked, span.to_range(), text))
            .collect(),
        notes: error.notes().map(str::to_owned).collect(),
    };
    if error.rule == Rule::Unsupported {
        error.notes = vec![NOT_YET.to_owned()];
    }
    Box::new(Fault {
        error,
        place: place_in_text,
    })
}

/// A message without numbers of expressions and types of naga.
fn plain(message: &str) -> String {
    if message.starts_with("Incompatible operands") {
        return "the operands of an operator do not fit each other".to_owned();
    }
    if message.starts_with("Invalid access into expression") {
        return "an expression is indexed that has no parts, or none of that number".to_owned();
    }
    message.replace("found \"\"", "found the end of the file")
}

/// What is said of WGSL that naga does not support.
pub(super) const NOT_YET: &str = "this is no fault of the shader: browsers with Tint (Chromium) take it, and naga, the compiler of wgpu and Firefox, does not yet";

/// Builtin inputs that naga does not know yet.
const NEW_BUILTINS: [&str; 2] = ["global_invocation_index", "workgroup_index"];

/// Whether naga says that the text is WGSL that it does not support, or needs a feature.
fn rule_of(compiler: &Compiler<'_>, message: &str, place: Option<Range<usize>>) -> Rule {
    let (text, capabilities) = (compiler.linked.wgsl(), compiler.capabilities);
    let before = place
        .clone()
        .and_then(|place| text.get(..place.start))
        .unwrap_or_default();
    let at = place.and_then(|place| text.get(place)).unwrap_or_default();
    let is_new = NEW_BUILTINS.contains(&at)
        || message.starts_with("expected `)`") && ["greater", "less", "any"].contains(&at)
        || message == "invalid left-hand side of assignment" && is_swizzle(at)
        || message.starts_with("expected `{`") && at == "@"
        || message.starts_with("expected `;`") && is_asserted(before);
    let is_optional = at
        .parse::<Features>()
        .is_ok_and(|feature| !capabilities.contains(feature.needs()));
    if message.ends_with("is not supported in the current environment") || is_optional {
        Rule::Feature
    } else if is_new
        || [
            "not yet supported",
            "not yet implemented",
            "Not implemented as constant",
        ]
        .iter()
        .any(|words| message.contains(words))
    {
        Rule::Unsupported
    } else {
        Rule::Wgsl
    }
}

/// Whether a condition in brackets stands right after `const_assert`: naga takes the brackets for all of it.
fn is_asserted(before: &str) -> bool {
    let statement = before.rsplit([';', '{', '}']).next().unwrap_or_default();
    let rest = statement.trim_start().strip_prefix("const_assert");
    rest.is_some_and(|rest| rest.trim_start().starts_with('('))
}

/// Whether an expression is a vector's components, each once.
fn is_swizzle(expression: &str) -> bool {
    let Some((_, components)) = expression.rsplit_once('.') else {
        return false;
    };
    let all = ["xyzw", "rgba"];
    let of_one = |set: &&str| components.chars().all(|c| set.contains(c));
    let once = |c: char| components.matches(c).count() == 1;
    components.len() > 1 && all.iter().any(of_one) && components.chars().all(once)
}

pub(super) fn of_validation_error(
    compiler: &Compiler<'_>,
    module: &naga::Module,
    error: &naga::WithSpan<ValidationError>,
) -> Box<Fault> {
    let linked = compiler.linked;
    let innermost = error.spans().last().and_then(|(span, _)| span.to_range());
    let said = Words {
        module,
        text: compiler.linked.wgsl(),
        at: innermost
            .and_then(|range| compiler.linked.wgsl().get(range))
            .unwrap_or_default(),
    }
    .of(error.as_inner());
    let spans = error.spans().filter(|(span, _)| span.is_defined());
    let mut spans: Vec<_> = spans.map(|(span, text)| (*span, text.as_str())).collect();
    // naga goes from the outside in.
    spans.reverse();
    // Of a variable that is used naga knows where it is declared; the use around it says more.
    let declares = |span: &Span| {
        let end = span.to_range().map(|range| range.end);
        let after = end.and_then(|end| compiler.linked.wgsl().get(end..));
        after.is_some_and(|after| after.trim_start().starts_with(':'))
    };
    if spans.first().is_some_and(|(span, _)| declares(span)) {
        spans.rotate_left(1);
    }
    if let Some(span) = said.span.filter(Span::is_defined) {
        spans.retain(|(other, _)| *other != span);
        spans.insert(0, (span, ""));
    }
    let in_text = spans.first().and_then(|(span, _)| span.to_range());
    let mut places: Vec<_> = spans
        .iter()
        .filter_map(|(span, text)| {
            // Names of naga's types and handles say nothing to the author of a shader.
            let text = if text.starts_with("naga::") { "" } else { text };
            place(linked, span.to_range(), text)
        })
        .collect();
    if places.is_empty() {
        places.extend(said.within.and_then(|word| find(linked, &word)));
    }
    // The place and, if it is another, the line around it.
    places.truncate(2);
    let mut notes = said.notes;
    if said.rule == Rule::Unsupported {
        notes.push(NOT_YET.to_owned());
    }
    Box::new(Fault {
        error: ShaderError {
            rule: said.rule,
            message: said.message,
            places,
            notes,
        },
        place: in_text,
    })
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
