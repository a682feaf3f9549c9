//! The number of loads per pixel does not depend on penumbrae: there are no loops and no branches around loads.

use moment_shadows::{Source, link, modules};
use naga::{Block, Expression, Module, Statement};

/// Loads of a function and of all that it calls, and whether any is repeated.
fn loads(module: &Module, name: &str) -> usize {
    let function = module
        .functions
        .iter()
        .find(|(_, function)| function.name.as_deref() == Some(name))
        .unwrap_or_else(|| panic!("there is no function '{name}'"))
        .1;
    let own = function
        .expressions
        .iter()
        .filter(|(_, expression)| matches!(expression, Expression::ImageLoad { .. }))
        .count();
    own + calls(&function.body)
        .into_iter()
        .map(|called| loads(module, module.functions[called].name.as_deref().unwrap()))
        .sum::<usize>()
}

/// What a block calls; a loop must not be there.
fn calls(block: &Block) -> Vec<naga::Handle<naga::Function>> {
    block
        .iter()
        .flat_map(|statement| match statement {
            Statement::Call { function, .. } => vec![*function],
            Statement::Block(block) => calls(block),
            Statement::If { accept, reject, .. } => [calls(accept), calls(reject)].concat(),
            Statement::Loop { .. } => panic!("a loop"),
            _ => Vec::new(),
        })
        .collect()
}

#[test]
fn they_are_as_many_as_documented() {
    let soft = modules()
        .iter()
        .find(|module| module.name == "moment_soft_shadows")
        .unwrap();
    let source = Source {
        name: soft.name,
        text: soft.source,
    };
    let text = link(source, &[]).unwrap().into_wgsl();
    let module = naga::front::wgsl::parse_str(&text).unwrap();
    // A query is one of two, as a constant of the node says.
    assert_eq!(loads(&module, "summed_area_table_mean_interpolated"), 16);
    assert_eq!(loads(&module, "summed_area_table_mean_plain"), 4);
    for name in [
        "moment_soft_shadows_intensity",
        "moment_soft_shadows_variance_intensity",
    ] {
        // Search and filter, each with both queries in its text.
        assert_eq!(loads(&module, name), 2 * (16 + 4), "{name}");
    }
}
