//! Where control goes after a statement (WGSL specification, section 9.8, "Statements Behavior Analysis"). naga takes loops without an
//! end, and `discard` for a `return`.

use naga::{Block, Function, Module, Span, Statement};

use crate::{Linked, Rule, ShaderError};

/// Where control may go after a statement.
#[derive(Clone, Copy, Default)]
pub(super) struct Behaviour {
    pub(super) next: bool,
    pub(super) breaks: bool,
    pub(super) continues: bool,
    pub(super) returns: bool,
}

impl Behaviour {
    pub(super) const NEXT: Self = Self {
        next: true,
        breaks: false,
        continues: false,
        returns: false,
    };

    pub(super) fn or(self, other: Self) -> Self {
        Self {
            next: self.next || other.next,
            breaks: self.breaks || other.breaks,
            continues: self.continues || other.continues,
            returns: self.returns || other.returns,
        }
    }

    /// Whether control goes on after the statement, whatever happens in it.
    pub(super) fn only_next(self) -> bool {
        self.next && !self.breaks && !self.continues && !self.returns
    }
}

/// Loops that are never left, and functions that end without the value that they give.
pub(super) fn check(module: &Module, linked: &Linked) -> Vec<ShaderError> {
    let mut found = Vec::new();
    let functions = module.functions.iter().map(|(handle, function)| {
        let span = module.functions.get_span(handle);
        (function, span)
    });
    let entry_points = module
        .entry_points
        .iter()
        .map(|it| (&it.function, Span::UNDEFINED));
    for (function, span) in functions.chain(entry_points) {
        let mut endless = Vec::new();
        let behaviour = block(&function.body, &mut endless);
        let at = |span: Span| span.to_range().and_then(|range| linked.location(range));
        for span in endless {
            found.push(ShaderError {
                rule: Rule::Wgsl,
                message: "this loop is never left; give it a `break`, or a `return`".to_owned(),
                places: at(span).into_iter().collect(),
                notes: Vec::new(),
            });
        }
        if function.result.is_some() && behaviour.next {
            let name = function.name.as_deref().unwrap_or_default();
            let place = at(span).or_else(|| super::diagnostic::find(linked, name));
            found.push(ShaderError {
                rule: Rule::Wgsl,
                message: format!("the end of function `{name}` can be reached without `return`"),
                places: place.into_iter().collect(),
                notes: vec![
                    "control goes on after `discard`, and after a `switch` with a `break`"
                        .to_owned(),
                ],
            });
        }
    }
    found
}

/// Whether the end of a function is never reached, without the `return` that naga puts there.
pub(super) fn ends(function: &Function) -> bool {
    let mut ignored = Vec::new();
    let written = function.body.iter().rev();
    let added = written
        .take_while(|it| matches!(it, Statement::Return { value: None }))
        .count();
    let count = function.body.len().saturating_sub(added);
    let statements = function.body.span_iter().take(count);
    !sequence(statements, &mut ignored).next
}

fn block(block: &Block, endless: &mut Vec<Span>) -> Behaviour {
    sequence(block.span_iter(), endless)
}

fn sequence<'a>(
    statements: impl Iterator<Item = (&'a Statement, &'a Span)>,
    endless: &mut Vec<Span>,
) -> Behaviour {
    let mut behaviour = Behaviour::NEXT;
    for (statement, span) in statements {
        if !behaviour.next {
            break;
        }
        behaviour.next = false;
        behaviour = behaviour.or(of(statement, *span, endless));
    }
    behaviour
}

fn of(statement: &Statement, span: Span, endless: &mut Vec<Span>) -> Behaviour {
    let none = Behaviour::default();
    match statement {
        Statement::Block(inner) => block(inner, endless),
        Statement::If { accept, reject, .. } => block(accept, endless).or(block(reject, endless)),
        Statement::Switch { cases, .. } => {
            // Of the selectors of one case naga makes cases that fall through to the last.
            let cases = cases.iter().filter(|case| !case.fall_through);
            let cases = cases.map(|case| block(&case.body, endless));
            let all = cases.fold(none, Behaviour::or);
            Behaviour {
                next: all.next || all.breaks,
                breaks: false,
                ..all
            }
        }
        Statement::Loop {
            body,
            continuing,
            break_if,
        } => {
            let body = block(body, endless);
            block(continuing, endless);
            let behaviour = Behaviour {
                next: body.breaks || break_if.is_some(),
                returns: body.returns,
                ..none
            };
            if !behaviour.next && !behaviour.returns {
                endless.push(span);
            }
            behaviour
        }
        Statement::Break => Behaviour {
            breaks: true,
            ..none
        },
        Statement::Continue => Behaviour {
            continues: true,
            ..none
        },
        Statement::Return { .. } => Behaviour {
            returns: true,
            ..none
        },
        _ => Behaviour::NEXT,
    }
}
