//! `moment-shadows graph`: checks and prints a graph file and its plan.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use moment_shadows::Profile;
use moment_shadows_graph::{Capabilities, Direction, NodeDesc, Plan};
use serde_json::Value;

use super::{CommandResult, argument};
use crate::error::LabError;
use crate::graph_file::GraphFile;

/// What `graph` takes.
#[derive(clap::Args)]
pub struct Options {
    /// The graph file.
    file: PathBuf,
    /// Also prints the compiled plan.
    #[arg(long)]
    plan: bool,
    /// Prints the plan as JSON.
    #[arg(long, requires = "plan")]
    json: bool,
    /// What the plan may rely on.
    #[arg(long, value_parser = argument::profile(), default_value = "native")]
    profile: Profile,
}

impl Options {
    /// Checks the file and prints it, or its plan as JSON.
    pub fn run(self) -> CommandResult {
        let (summary, plan) = check(&self.file, self.profile)?;
        if self.json {
            println!("{}", serde_json::to_string_pretty(&plan)?);
            return Ok(ExitCode::SUCCESS);
        }
        println!("{summary}");
        if self.plan {
            println!("\n{plan}");
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// Compiles a graph file for a profile, with its imports as the file expects them, without a device. Gives its plan, and
/// the graph as text.
fn check(path: &Path, profile: Profile) -> Result<(String, Plan), LabError> {
    let file = GraphFile::read(path, None)?;
    let capabilities = Capabilities::of_profile(profile);
    let failed = LabError::graph(&file.name);
    let plan = file.graph.compile(&capabilities, &[]).map_err(failed)?;
    let failed = LabError::graph(&file.name);
    let nodes = file.graph.describe(&capabilities, &[]).map_err(failed)?;
    Ok((summary(&file, &nodes), plan))
}

/// The graph as text: imports, nodes with their properties and slots, edges and outputs.
fn summary(file: &GraphFile, described: &[NodeDesc]) -> String {
    let graph = &file.graph;
    let mut lines = Vec::new();
    for import in &graph.imports {
        let expected = import.value.as_ref();
        let expected = expected.map_or("anything".to_owned(), ToString::to_string);
        lines.push(format!("import  {:<24} {expected}", import.name));
    }
    for (node, desc) in graph.nodes.iter().zip(described) {
        let properties = match file.node_entry(&node.name, "properties") {
            Value::Null => String::new(),
            given => format!(" {given}"),
        };
        lines.push(format!(
            "node    {:<24} {}{properties}",
            node.name, desc.name
        ));
        for slot in &desc.slots {
            let arrow = match slot.direction {
                Direction::In => "<-",
                Direction::Out => "->",
                Direction::InOut => "<->",
                Direction::Internal => continue,
            };
            lines.push(format!(
                "        {:<24} {arrow} {}",
                format!("{}.{}", node.name, slot.name),
                slot.description
            ));
        }
    }
    for edge in &graph.edges {
        lines.push(format!("edge    {:<24} -> {}", edge.from, edge.to));
    }
    for output in &graph.outputs {
        lines.push(format!("output  {:<24} <- {}", output.name, output.value));
    }
    lines.join("\n")
}
