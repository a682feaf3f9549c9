//! How much a shader makes of what is not uniform (WGSL specification, section 2.3, "Diagnostics").

use naga::diagnostic_filter::{
    FilterableTriggeringRule, Severity, StandardFilterableTriggeringRule,
};
use naga::{Function, Module};

/// What has to be uniform, by what may be said about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    /// `derivative_uniformity`: derivatives, and samples that take them.
    Derivatives,
    /// `subgroup_uniformity`: subgroup operations.
    Subgroups,
    /// Barriers: nothing allows them elsewhere.
    Always,
}

/// What the nearest filter around says of a rule.
pub(super) fn severity(module: &Module, function: &Function, rule: Rule) -> Severity {
    use FilterableTriggeringRule::{Standard, Unknown};
    let derivatives = Standard(StandardFilterableTriggeringRule::DerivativeUniformity);
    let mut next = function.diagnostic_filter_leaf;
    while let Some(handle) = next {
        let node = &module.diagnostic_filters[handle];
        let named = &node.inner.triggering_rule;
        let is_meant = match rule {
            Rule::Derivatives => *named == derivatives,
            Rule::Subgroups => matches!(named, Unknown(name) if **name == *"subgroup_uniformity"),
            Rule::Always => false,
        };
        if is_meant {
            return node.inner.new_severity;
        }
        next = node.parent;
    }
    Severity::Error
}
