//! What a shader stage does not have, where it stands.

use naga::{
    Barrier, EntryPoint, Expression, Function, Module, SampleLevel, ShaderStage, Span, Statement,
};

use super::statements;

/// The first operation that the stage of `entry_point` does not have, and its place in the entry point or in a function that it calls.
pub(super) fn forbidden(module: &Module, entry_point: &EntryPoint) -> Option<(&'static str, Span)> {
    let mut waiting = vec![&entry_point.function];
    let mut seen = std::collections::BTreeSet::new();
    while let Some(function) = waiting.pop() {
        let found = in_function(function, entry_point.stage);
        if found.is_some() {
            return found;
        }
        statements::each(&function.body, &mut |statement, _| {
            if let Statement::Call { function, .. } = statement
                && seen.insert(*function)
            {
                waiting.push(&module.functions[*function]);
            }
        });
    }
    None
}

fn in_function(function: &Function, stage: ShaderStage) -> Option<(&'static str, Span)> {
    if stage != ShaderStage::Fragment {
        let implicit = function
            .expressions
            .iter()
            .find_map(|(handle, expression)| {
                let what = match expression {
                    Expression::Derivative { .. } => "a derivative",
                    Expression::ImageSample {
                        level: SampleLevel::Auto | SampleLevel::Bias(_),
                        ..
                    } => "a sample with a level that it finds by derivatives",
                    _ => return None,
                };
                Some((what, function.expressions.get_span(handle)))
            });
        if implicit.is_some() {
            return implicit;
        }
    }
    let mut found = None;
    statements::each(&function.body, &mut |statement, span| {
        let what = match statement {
            Statement::Kill if stage != ShaderStage::Fragment => "`discard`",
            Statement::ControlBarrier(barrier) | Statement::MemoryBarrier(barrier)
                if stage != ShaderStage::Compute && !barrier.contains(Barrier::SUB_GROUP) =>
            {
                "a barrier"
            }
            Statement::WorkGroupUniformLoad { .. } if stage != ShaderStage::Compute => {
                "`workgroupUniformLoad`"
            }
            _ => return,
        };
        found.get_or_insert((what, span));
    });
    found
}
