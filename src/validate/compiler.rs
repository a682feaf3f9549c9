//! The WGSL compiler, naga.

use core::ops::Range;

use naga::Module;
use naga::front::wgsl::{Frontend, Options, ParseError};
use naga::valid::{Capabilities, ModuleInfo, ValidationError, ValidationFlags, Validator};

use super::diagnostic;
use crate::{Linked, ShaderError};

/// A module that naga takes.
pub(super) struct Compiled {
    pub(super) module: Module,
    pub(super) info: ModuleInfo,
}

/// What naga refuses, and where in the text.
pub(super) struct Fault {
    pub(super) error: ShaderError,
    pub(super) place: Option<Range<usize>>,
}

/// A text and what it may use.
pub(super) struct Compiler<'a> {
    pub(super) linked: &'a Linked,
    pub(super) capabilities: Capabilities,
}

impl Compiler<'_> {
    pub(super) fn compile(&self) -> Result<Compiled, Box<Fault>> {
        let module = parse(self.linked.wgsl(), self.capabilities)
            .map_err(|error| diagnostic::of_parse_error(self, &error))?;
        let info = check(&module, self.capabilities)
            .map_err(|error| diagnostic::of_validation_error(self, &module, &error))?;
        Ok(Compiled { module, info })
    }
}

pub(super) fn parse(text: &str, capabilities: Capabilities) -> Result<Module, Box<ParseError>> {
    let mut options = Options::new();
    options.capabilities = capabilities;
    Frontend::new_with_options(options)
        .parse(text)
        .map_err(Box::new)
}

pub(super) fn check(
    module: &Module,
    capabilities: Capabilities,
) -> Result<ModuleInfo, Box<naga::WithSpan<ValidationError>>> {
    Validator::new(ValidationFlags::all(), capabilities)
        .validate(module)
        .map_err(Box::new)
}
