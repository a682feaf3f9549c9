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
    let entry_points = module.entry_points.iter();
    let entry_points = entry_points.map(|it| (&it.function, Span::UNDEFINED));
    for (function, span) in functions.chain(entry_points) {
        let mut walk = Walk::of(function);
        let behaviour = walk.block(&function.body);
        let at = |span: Span| span.to_range().and_then(|range| linked.location(range));
        for span in walk.endless {
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
            let why = "control goes on after `discard`, and after a `switch` with a `break`";
            found.push(ShaderError {
                rule: Rule::Wgsl,
                message: format!("the end of function `{name}` can be reached without `return`"),
                places: place.into_iter().collect(),
                notes: vec![why.to_owned()],
            });
        }
    }
    found
}

/// Whether the end of a function that gives a value is never reached.
pub(super) fn never_ends(function: &Function) -> bool {
    !Walk::of(function).block(&function.body).next
}

/// A function that is followed.
struct Walk {
    /// Whether it gives a value: a `return` without one is then naga's own, at the end.
    gives: bool,
    /// Loops that are never left.
    endless: Vec<Span>,
}

impl Walk {
    fn of(function: &Function) -> Self {
        Self {
            gives: function.result.is_some(),
            endless: Vec::new(),
        }
    }

    fn block(&mut self, block: &Block) -> Behaviour {
        let mut behaviour = Behaviour::NEXT;
        for (statement, span) in block.span_iter() {
            if !behaviour.next {
                break;
            }
            behaviour.next = false;
            behaviour = behaviour.or(self.statement(statement, *span));
        }
        behaviour
    }

    fn statement(&mut self, statement: &Statement, span: Span) -> Behaviour {
        let none = Behaviour::default();
        match statement {
            Statement::Block(inner) => self.block(inner),
            Statement::If { accept, reject, .. } => self.block(accept).or(self.block(reject)),
            Statement::Switch { cases, .. } => {
                // Of the selectors of one case naga makes cases that fall through to the last.
                let cases = cases.iter().filter(|case| !case.fall_through);
                let all = cases.fold(none, |all, case| all.or(self.block(&case.body)));
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
                let body = self.block(body);
                self.block(continuing);
                let behaviour = Behaviour {
                    next: body.breaks || break_if.is_some(),
                    returns: body.returns,
                    ..none
                };
                if !behaviour.next && !behaviour.returns {
                    self.endless.push(span);
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
            Statement::Return { value: None } if self.gives => Behaviour::NEXT,
            Statement::Return { .. } => Behaviour {
                returns: true,
                ..none
            },
            _ => Behaviour::NEXT,
        }
    }
}
