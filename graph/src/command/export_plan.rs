//! `moment-shadows export-plan`: the compiled plan of a graph file, as JSON.

use std::path::PathBuf;
use std::process::ExitCode;

use moment_shadows::Profile;

use super::{CommandError, GraphFile, Part, argument, output};
use crate::error::unknown;
use crate::{Capabilities, GraphError, GraphErrorKind, ResourceDesc, TextureDesc};

/// What `export-plan` takes.
#[derive(Debug, clap::Args)]
pub struct Options {
    /// The graph file.
    file: PathBuf,
    /// What the plan may rely on.
    #[arg(long, value_parser = argument::profile(), default_value = "native")]
    profile: Profile,
    /// The size of an import, instead of the graph file's: `light_depth=2048x2048`.
    #[arg(long, value_name = "NAME=WxH", value_parser = size)]
    size: Vec<(String, [u32; 2])>,
    /// The index of the bind group that all passes use.
    #[arg(long, default_value_t = 0)]
    bind_group: u32,
    /// A feature of WebGPU, beyond the profile's, that the plan may rely on.
    #[arg(long, value_name = "FEATURE", value_delimiter = ',', value_parser = [FLOAT32_FILTERABLE])]
    allow: Vec<String>,
    /// Leave out comments, and functions that no pass calls.
    #[arg(long)]
    compact: bool,
    /// The file to write, whole or not at all, instead of the output.
    #[arg(long)]
    out: Option<PathBuf>,
}

/// The feature by which float32 maps are sampled with a filter.
const FLOAT32_FILTERABLE: &str = "float32-filterable";

/// An import's name and size.
fn size(text: &str) -> Result<(String, [u32; 2]), String> {
    let parsed = text.split_once('=').and_then(|(name, size)| {
        let (width, height) = size.split_once('x')?;
        let size = [width.parse().ok()?, height.parse().ok()?];
        Some((name.to_owned(), size))
    });
    parsed.ok_or_else(|| "it is written NAME=WxH, as in light_depth=2048x2048".to_owned())
}

impl Options {
    /// Compiles the file and writes its plan.
    ///
    /// # Errors
    /// [`CommandError`] if the graph is not valid, or the plan cannot be written.
    pub fn run(self) -> Result<ExitCode, CommandError> {
        // An output that cannot be written is refused before the work.
        let part = self.out.as_deref().map(Part::beside).transpose()?;
        let capabilities = Capabilities {
            float32_filterable: self.allow.iter().any(|it| it == FLOAT32_FILTERABLE),
            bind_group: self.bind_group,
            ..Capabilities::of_profile(self.profile)
        };
        let file = GraphFile::read(&self.file)?;
        let mut imports = Vec::new();
        for (number, (name, size)) in self.size.iter().enumerate() {
            let mut earlier = self.size.iter().take(number);
            if earlier.any(|(other, _)| other == name) {
                let message = format!("--size gives import '{name}' two sizes; leave one out");
                let error = GraphError::new(GraphErrorKind::Size, message);
                return Err(CommandError::graph(&file.name)(error));
            }
            let known = file.graph.imports.iter().map(|import| import.name.as_str());
            let import = file.graph.imports.iter().find(|it| it.name == *name);
            let import = import.ok_or_else(|| unknown("import", name, known, "in --size"));
            let import = import.map_err(CommandError::graph(&file.name))?;
            let Some(ResourceDesc::Texture(texture)) = &import.value else {
                let message = format!(
                    "import '{name}' has no texture in the graph file, so that a size alone does not describe it; write its format \
                     there, as \"texture\""
                );
                let error = GraphError::new(GraphErrorKind::MissingImport, message);
                return Err(CommandError::graph(&file.name)(
                    error.at_position(import.position),
                ));
            };
            let texture = TextureDesc {
                size: *size,
                ..texture.clone()
            };
            imports.push((name.as_str(), ResourceDesc::Texture(texture)));
        }
        let mut plan = file.compile(&capabilities, &imports)?;
        if self.compact {
            plan.compact().map_err(CommandError::graph(&file.name))?;
        }
        let text = serde_json::to_string_pretty(&plan)?;
        match part {
            None => output::print(text)?,
            Some(part) => part.write(|file| writeln!(file, "{text}"))?.keep()?,
        }
        Ok(ExitCode::SUCCESS)
    }
}
