//! Plans whose shaders hold what machines read.

use moment_shadows::{Source, compact};

use super::Plan;
use crate::{GraphError, GraphErrorKind};

impl Plan {
    /// Leaves out of each shader its comments, and what none of the passes that use it reaches.
    ///
    /// # Errors
    /// [`GraphErrorKind::Shader`] if a shader of a plan from elsewhere is no linked text.
    pub fn compact(&mut self) -> Result<(), GraphError> {
        for (index, text) in self.shaders.iter_mut().enumerate() {
            let passes = self.passes.iter().filter(|pass| pass.shader == Some(index));
            let roots = passes.flat_map(|pass| {
                let constants = pass.constants.keys().map(String::as_str);
                constants
                    .chain([pass.entry_point.as_str()])
                    .chain(pass.vertex_entry_point.as_deref())
            });
            let roots: Vec<&str> = roots.collect();
            let name = format!("shader {index}");
            *text = compact(Source { name: &name, text }, &roots)
                .map_err(|error| GraphError::new(GraphErrorKind::Shader, error.to_string()))?;
        }
        Ok(())
    }
}
