//! Uniformity: what has to be called by all invocations of a group together (WGSL specification, section 15). naga follows neither
//! variables nor calls, so browsers refuse what it accepts; this is the specification's own analysis, on naga's module.

mod call;
mod expression;
mod function;
mod graph;
mod names;
mod operands;
mod severity;
mod summary;

use std::collections::BTreeSet;

use naga::diagnostic_filter::Severity;
use naga::{Function, Module, Span};

use self::function::{Walked, walk};
use self::graph::{Label, Node};
use self::summary::{Requirement, Summary};
use super::ValidationReport;
use crate::{Linked, Rule, ShaderError};

/// What is not uniform and has to be.
pub(super) fn check(module: &Module, linked: &Linked, found: &mut ValidationReport) {
    let mut seen = BTreeSet::new();
    let mut summaries: Vec<Summary> = Vec::new();
    // naga has callees before their callers.
    for (_, function) in module.functions.iter() {
        let walked = walk(module, function, None, &summaries);
        summaries.push(walked.summary());
        report(linked, function, &walked, &mut seen, found);
    }
    for entry_point in &module.entry_points {
        let function = &entry_point.function;
        let walked = walk(module, function, Some(entry_point), &summaries);
        report(linked, function, &walked, &mut seen, found);
    }
}

/// Adds a finding for each place that has to be uniform and is not, once for each.
fn report(
    linked: &Linked,
    function: &Function,
    walked: &Walked,
    seen: &mut BTreeSet<Option<(usize, usize)>>,
    found: &mut ValidationReport,
) {
    let differs = walked.graph.reach(walked.differs);
    for (node, requirement) in &walked.required {
        if !differs.holds(*node)
            || !seen.insert(requirement.span.to_range().map(|it| (it.start, it.end)))
        {
            continue;
        }
        let said = match requirement.severity {
            Severity::Error => &mut found.errors,
            Severity::Off | Severity::Info | Severity::Warning => &mut found.warnings,
        };
        let way = differs.way(*node);
        said.push(explain(linked, function, walked, requirement, &way));
    }
}

/// Says what has to be uniform, how it is reached, and what it depends on.
fn explain(
    linked: &Linked,
    function: &Function,
    walked: &Walked,
    requirement: &Requirement,
    way: &[Node],
) -> ShaderError {
    let by = requirement.by;
    let mut places = Vec::new();
    let mut point = |span: Span, label: &str| {
        let place = span.to_range().and_then(|range| linked.location(range));
        places.extend(place.map(|place| place.labelled(label)));
    };
    point(requirement.span, "");
    for call in &requirement.calls {
        point(*call, "called here");
    }
    let labels: Vec<&Label> = way
        .iter()
        .filter_map(|node| walked.graph.label(*node))
        .collect();
    let conditions = labels.iter().filter_map(|label| match label {
        Label::Condition(span) => Some(*span),
        _ => None,
    });
    if let Some(condition) = conditions.clone().next() {
        point(condition, "decided by this");
    }
    match labels.last() {
        Some(Label::BuiltIn(_, span)) => {
            point(*span, "a builtin input, which differs between invocations")
        }
        Some(Label::Input(span)) => point(*span, "an input, which differs between invocations"),
        Some(Label::Memory(reader)) => {
            let span = function.expressions.get_span(*reader);
            point(span, "read from memory that invocations may find different");
        }
        Some(Label::Result(span)) => point(*span, "a result that differs between invocations"),
        Some(Label::Condition(_) | Label::Parameter(_)) | None => {}
    }
    let remedy = if requirement.control_flow && is_sample(by) {
        "; call it before the branch, or use a function with a level or gradients (`textureSampleLevel`, `textureSampleGrad`)"
    } else if requirement.control_flow {
        "; call it outside of branches, loops and returns that not all invocations take"
    } else {
        ""
    };
    let message = if requirement.control_flow {
        format!(
            "`{by}` must be called by all invocations together, and not all may reach this call{remedy}"
        )
    } else {
        format!("an argument of `{by}` must be the same for all invocations, and may not be")
    };
    ShaderError {
        rule: Rule::Uniformity,
        message,
        places,
        notes: Vec::new(),
    }
}

fn is_sample(function: &str) -> bool {
    function.starts_with("textureSample")
}
