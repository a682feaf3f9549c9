//! A plan without some of its nodes.

use moment_shadows_graph::{Instead, Lives, Plan, PlannedBindingResource, PlannedUse};

use crate::error::HostError;

/// The plan without the passes of some nodes. What stands in for their outputs is bound in their place; a host fills it where it is
/// a texel.
pub fn without(plan: &Plan, nodes: &[&str]) -> Result<Plan, HostError> {
    let mut plan = plan.clone();
    for &node in nodes {
        if !plan.passes.iter().any(|pass| pass.node == node) {
            let known = plan.passes.iter().map(|pass| &pass.node);
            return Err(unknown("node", node, known));
        }
        plan.passes.retain(|pass| pass.node != node);
        let off = plan.off.iter().filter(|off| off.node == node);
        for (output, instead) in off
            .map(|off| (off.output, off.instead.clone()))
            .collect::<Vec<_>>()
        {
            if let Instead::Bypass(instead) = instead {
                pass_by(&mut plan, output, instead);
            }
        }
    }
    plan.update_hazards();
    Ok(plan)
}

/// Lets those that read an output read another resource, which lives as long then.
fn pass_by(plan: &mut Plan, output: usize, instead: usize) {
    for binding in plan.passes.iter_mut().flat_map(|pass| &mut pass.bindings) {
        if let PlannedBindingResource::Texture { resource, .. } = &mut binding.resource
            && *resource == output
        {
            *resource = instead;
        }
    }
    for named in &mut plan.outputs {
        if named.value == output {
            named.value = instead;
        }
    }
    let lives = plan.resources[output].lives;
    if plan.resources[instead].lives == Lives::Frame {
        plan.resources[instead].lives = lives;
    }
}

/// The texels that stand in for a resource that is read and that no pass writes.
pub fn stand_in(plan: &Plan, index: usize) -> Result<Option<&[[f64; 4]]>, HostError> {
    let touched = |uses: &[PlannedUse]| uses.iter().any(|it| it.resource == index);
    let is_output = plan.outputs.iter().any(|output| output.value == index);
    let is_read = is_output || plan.passes.iter().any(|pass| touched(&pass.reads));
    if !is_read || plan.passes.iter().any(|pass| touched(&pass.writes)) {
        return Ok(None);
    }
    let off = plan.off.iter().find(|off| off.output == index);
    match off.map(|off| &off.instead) {
        Some(Instead::Fill(texels)) => Ok(Some(texels)),
        _ => Err(HostError::Unwritten(plan.resources[index].name.clone())),
    }
}

fn unknown<'a>(
    kind: &'static str,
    name: &str,
    known: impl Iterator<Item = &'a String>,
) -> HostError {
    let mut known: Vec<&str> = known.map(String::as_str).collect();
    known.dedup();
    let (name, known) = (name.to_owned(), known.join(", "));
    HostError::Unknown { kind, name, known }
}
