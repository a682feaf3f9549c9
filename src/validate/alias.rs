//! Two names of one memory, of which one is written (WGSL specification, section 12.5.5, "Alias Analysis"). naga does not look for them.

use std::collections::BTreeMap;

use naga::{Expression, Function, GlobalVariable, Handle, Module, Statement};

use super::pointer::{Root, memory, root};
use super::statements;
use crate::{Linked, Rule, ShaderError};

/// What is done with a memory.
#[derive(Clone, Copy, Debug, Default)]
struct Access {
    reads: bool,
    writes: bool,
}

impl Access {
    const READS: Self = Self {
        reads: true,
        writes: false,
    };
    const WRITES: Self = Self {
        reads: false,
        writes: true,
    };

    fn add(&mut self, other: Access) {
        self.reads |= other.reads;
        self.writes |= other.writes;
    }

    /// Whether one access may see what the other writes.
    fn meets(self, other: Access) -> bool {
        self.writes && (other.reads || other.writes) || other.writes && self.reads
    }
}

/// What a function does with the memory that it is given and the one of the module.
#[derive(Clone, Debug, Default)]
struct Uses {
    parameters: BTreeMap<u32, Access>,
    variables: BTreeMap<Handle<GlobalVariable>, Access>,
}

impl Uses {
    fn add(&mut self, root: Option<Root>, access: Access) {
        match root {
            Some(Root::Parameter(index)) => self.parameters.entry(index).or_default().add(access),
            Some(Root::Global(variable)) => self.variables.entry(variable).or_default().add(access),
            Some(Root::Local(_)) | None => {}
        }
    }
}

/// Calls that are given two names of one memory, of which the function writes one.
pub(super) fn check(module: &Module, linked: &Linked) -> Vec<ShaderError> {
    let mut found = Vec::new();
    let mut uses: Vec<Uses> = Vec::new();
    // naga has callees before their callers.
    for (_, function) in module.functions.iter() {
        let of = follow(module, function, &uses, linked, &mut found);
        uses.push(of);
    }
    for entry_point in &module.entry_points {
        follow(module, &entry_point.function, &uses, linked, &mut found);
    }
    found
}

fn follow(
    module: &Module,
    function: &Function,
    callees: &[Uses],
    linked: &Linked,
    found: &mut Vec<ShaderError>,
) -> Uses {
    let mut uses = Uses::default();
    for (_, expression) in function.expressions.iter() {
        if let Expression::Load { pointer } = expression {
            uses.add(root(function, *pointer), Access::READS);
        }
    }
    statements::each(&function.body, &mut |statement, span| match statement {
        Statement::Store { pointer, .. } => uses.add(root(function, *pointer), Access::WRITES),
        Statement::Atomic { pointer, .. } => {
            uses.add(root(function, *pointer), Access::READS);
            uses.add(root(function, *pointer), Access::WRITES);
        }
        Statement::WorkGroupUniformLoad { pointer, .. } => {
            uses.add(root(function, *pointer), Access::READS);
        }
        Statement::Call {
            function: callee,
            arguments,
            ..
        } => {
            let Some(of) = callees.get(callee.index()) else {
                return;
            };
            let given: Vec<(Root, Access, Handle<Expression>)> = (0..)
                .zip(arguments)
                .filter_map(|(index, argument)| {
                    let access = *of.parameters.get(&index)?;
                    Some((memory(module, function, *argument)?, access, *argument))
                })
                .collect();
            let name = module.functions[*callee]
                .name
                .as_deref()
                .unwrap_or_default();
            found.extend(meeting(module, of, &given).map(|(at, why)| {
                let own = function.expressions.get_span(at).to_range();
                let range = own.or(span.to_range());
                ShaderError {
                    rule: Rule::Alias,
                    message: format!(
                        "this argument of `{name}` points at memory that the function reaches by {why} as well, and writes; give it a copy"
                    ),
                    places: range.and_then(|range| linked.location(range)).into_iter().collect(),
                    notes: Vec::new(),
                }
            }));
            for (root, access, _) in given {
                uses.add(Some(root), access);
            }
            for (variable, access) in &of.variables {
                uses.add(Some(Root::Global(*variable)), *access);
            }
        }
        _ => {}
    });
    uses
}

/// The first argument that meets another, or a variable that the function uses by its name.
fn meeting(
    module: &Module,
    callee: &Uses,
    given: &[(Root, Access, Handle<Expression>)],
) -> Option<(Handle<Expression>, String)> {
    for (index, (root, access, argument)) in given.iter().enumerate() {
        let before = given.iter().take(index);
        if before
            .clone()
            .any(|(other, of, _)| other == root && access.meets(*of))
        {
            return Some((*argument, "another argument".to_owned()));
        }
        if let Root::Global(variable) = root
            && let Some(of) = callee.variables.get(variable)
            && access.meets(*of)
        {
            let name = module.global_variables[*variable].name.as_deref();
            return Some((
                *argument,
                format!("the name `{}`", name.unwrap_or_default()),
            ));
        }
    }
    None
}
