//! Library modules as naga reads them, and the numbers in them.

use moment_shadows::{Source, link, modules};
use naga::{Expression, Literal, Module};

pub(crate) fn parse(wgsl: &str) -> Module {
    naga::front::wgsl::parse_str(wgsl)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(wgsl)))
}

/// A library module, whole, with what it imports. `item` is one that it defines.
pub(crate) fn module(name: &str, item: &str) -> Module {
    let module = modules().iter().find(|it| it.name == name).unwrap();
    assert!(module.source.contains(item), "{name} has no {item}");
    let source = Source {
        name,
        text: module.source,
    };
    parse(link(source, &[]).unwrap().wgsl())
}

/// The numbers that a constant of a module is made of.
pub(crate) fn constant(module: &Module, name: &str) -> Vec<f64> {
    let (_, found) = module
        .constants
        .iter()
        .find(|(_, candidate)| candidate.name.as_deref() == Some(name))
        .unwrap_or_else(|| panic!("there is no constant {name}"));
    numbers(module, found.init)
}

fn numbers(module: &Module, expression: naga::Handle<Expression>) -> Vec<f64> {
    match &module.global_expressions[expression] {
        Expression::Literal(Literal::F32(value)) => vec![f64::from(*value)],
        Expression::Literal(Literal::U32(value)) => vec![f64::from(*value)],
        Expression::Literal(Literal::I32(value)) => vec![f64::from(*value)],
        Expression::Compose { components, .. } => components
            .iter()
            .flat_map(|&component| numbers(module, component))
            .collect(),
        other => panic!("not a constant of numbers: {other:?}"),
    }
}
