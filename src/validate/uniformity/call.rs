//! What is stored, and what calls do with what they are given.

use naga::{Expression, Handle, Span};

use super::super::pointer::memory;
use super::function::Walk;
use super::graph::{Label, Node};
use super::severity::Rule;
use super::summary::{Outcome, Source, Summary};

impl Walk<'_> {
    /// Something is stored that depends on `values`.
    pub(super) fn store(&mut self, pointer: Handle<Expression>, values: &[Node], control: Node) {
        let place = self.place(pointer, control);
        let Some(variable) = place.variable else {
            return;
        };
        let mut depends = values.to_vec();
        depends.extend(&place.indices);
        if place.is_part {
            depends.push(self.variables[variable]);
        }
        self.variables[variable] = self.graph.node(&depends);
    }

    pub(super) fn call(
        &mut self,
        callee: &Summary,
        arguments: &[Handle<Expression>],
        result: Option<Handle<Expression>>,
        control: Node,
        span: Span,
    ) {
        let mut values = Vec::new();
        let mut held = Vec::new();
        for argument in arguments {
            let memory = memory(self.module, self.function, *argument);
            let place = memory.map(|_| self.place(*argument, control));
            values.push(match &place {
                Some(place) => {
                    let mut depends = place.indices.clone();
                    depends.push(control);
                    self.graph.node(&depends)
                }
                None => self.value(*argument, control),
            });
            held.push(match place.and_then(|place| place.variable) {
                Some(variable) => self.variables[variable],
                None => self.differs,
            });
        }
        let given = |source: Source| match source {
            Source::Call => control,
            Source::Argument(index) => values.get(index).copied().unwrap_or(control),
            Source::Contents(index) => held.get(index).copied().unwrap_or(control),
        };
        for (source, requirement) in &callee.required {
            let mut requirement = requirement.clone();
            requirement.calls.push(span);
            self.required.push((given(*source), requirement));
        }
        let depends = |outcome: &Outcome| {
            let mut depends: Vec<Node> = outcome.sources.iter().map(|it| given(*it)).collect();
            depends.push(control);
            depends
        };
        if let Some(result) = result {
            let mut depends = depends(&callee.returned);
            if callee.returned.never_uniform {
                depends.push(self.graph.labelled(&[self.differs], Label::Result(span)));
            }
            let value = self.graph.node(&depends);
            self.set(result, value);
        }
        for (argument, outcome) in arguments.iter().zip(&callee.contents) {
            if let Some(outcome) = outcome {
                // Whether the function stores anything there or not.
                let mut depends = depends(outcome);
                if outcome.never_uniform {
                    let label = Label::Result(span);
                    depends.push(self.graph.labelled(&[self.differs], label));
                }
                self.store(*argument, &depends, control);
            }
        }
    }

    pub(super) fn subgroup(
        &mut self,
        result: Handle<Expression>,
        index: Option<Handle<Expression>>,
        by: &'static str,
        control: Node,
        span: Span,
    ) {
        self.require_uniform(control, by, Rule::Subgroups, span);
        if let Some(index) = index {
            let index = self.value(index, control);
            self.require(index, false, by, Rule::Subgroups, span);
        }
        let value = self.graph.labelled(&[self.differs], Label::Result(span));
        self.set(result, value);
    }
}
