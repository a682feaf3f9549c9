//! `moment-shadows graph`: checks and prints a graph file and its plan.

use std::path::PathBuf;
use std::process::ExitCode;

use moment_shadows::Profile;
use serde_json::Value;

use super::{CommandError, GraphFile, argument, output};
use crate::{Capabilities, Direction, NodeDesc};

/// What `graph` takes.
#[derive(Debug, clap::Args)]
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
    ///
    /// # Errors
    /// [`CommandError`] if the graph is not valid, or nothing can be printed.
    pub fn run(self) -> Result<ExitCode, CommandError> {
        let file = GraphFile::read(&self.file)?;
        let capabilities = Capabilities::of_profile(self.profile);
        let plan = file.compile(&capabilities, &[])?;
        if self.json {
            output::print(serde_json::to_string_pretty(&plan)?)?;
            return Ok(ExitCode::SUCCESS);
        }
        let described = file.graph.describe(&capabilities, &[]);
        let described = described.map_err(CommandError::graph(&file.name))?;
        output::print(summary(&file, &described)?)?;
        if self.plan {
            output::print(format_args!("\n{plan}"))?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// The graph as text: imports, nodes with their properties and slots, edges and outputs.
fn summary(file: &GraphFile, described: &[NodeDesc]) -> Result<String, CommandError> {
    let graph = &file.graph;
    let given: Value = serde_json::from_str(&file.text)?;
    let mut lines = Vec::new();
    for import in &graph.imports {
        let expected = import.value.as_ref();
        let expected = expected.map_or("anything".to_owned(), ToString::to_string);
        lines.push(format!("import  {:<24} {expected}", import.name));
    }
    for (index, (node, desc)) in graph.nodes.iter().zip(described).enumerate() {
        let properties = given["nodes"][index].get("properties");
        let properties = properties.map_or(String::new(), |given| format!(" {given}"));
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
    Ok(lines.join("\n"))
}
