//! The rules that shaders may break.

use core::fmt;

/// What an error of a shader is about. The names are kept from version to version, so that tools may go by them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Rule {
    /// The file cannot be read.
    File,
    /// The text is too long to be validated.
    Length,
    /// The text is of another dialect, or of another language.
    Dialect,
    /// An import names what there is not, or is not written as one.
    Import,
    /// The text is not WGSL, by its grammar, names or types.
    Wgsl,
    /// WGSL that browsers with Tint take, and naga, the compiler of wgpu and Firefox, does not yet.
    Unsupported,
    /// The shader uses an optional feature that is not allowed.
    Feature,
    /// The profile does not store the format of a storage texture.
    StorageFormat,
    /// An entry point uses more than every device has.
    Limit,
    /// A stage uses what it cannot.
    Stage,
    /// Something that all invocations have to reach together may not be reached by all.
    Uniformity,
    /// Two names of one memory, of which one is written.
    Alias,
    /// Operators that WGSL has no order for.
    Operator,
    /// A constant expression has no value of its type, or is none where one has to be.
    Constant,
    /// No value could be found with which an override is valid.
    Override,
    /// The shader cannot be written for a backend.
    Backend,
}

impl Rule {
    /// Every rule.
    pub const ALL: [Rule; 16] = [
        Rule::File,
        Rule::Length,
        Rule::Dialect,
        Rule::Import,
        Rule::Wgsl,
        Rule::Unsupported,
        Rule::Feature,
        Rule::StorageFormat,
        Rule::Limit,
        Rule::Stage,
        Rule::Uniformity,
        Rule::Alias,
        Rule::Operator,
        Rule::Constant,
        Rule::Override,
        Rule::Backend,
    ];

    /// The name in output.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Rule::File => "file",
            Rule::Length => "length",
            Rule::Dialect => "dialect",
            Rule::Import => "import",
            Rule::Wgsl => "wgsl",
            Rule::Unsupported => "unsupported",
            Rule::Feature => "feature",
            Rule::StorageFormat => "storage-format",
            Rule::Limit => "limit",
            Rule::Stage => "stage",
            Rule::Uniformity => "uniformity",
            Rule::Alias => "alias",
            Rule::Operator => "operator",
            Rule::Constant => "constant",
            Rule::Override => "override",
            Rule::Backend => "backend",
        }
    }

    /// What breaks the rule, in a sentence.
    #[must_use]
    pub fn description(self) -> &'static str {
        match self {
            Rule::File => "The file cannot be read.",
            Rule::Length => "The text is longer than what is validated.",
            Rule::Dialect => "The text is of a dialect of WGSL, or of another language.",
            Rule::Import => "An import names what does not exist, or is not written as one.",
            Rule::Wgsl => "The text is not WGSL by its grammar, names or types.",
            Rule::Unsupported => {
                "naga, the compiler of wgpu and Firefox, does not support this WGSL yet."
            }
            Rule::Feature => "The shader uses an optional feature that is not allowed.",
            Rule::StorageFormat => "The profile has no storage texture of this format and access.",
            Rule::Limit => "An entry point uses more than every WebGPU device has.",
            Rule::Stage => "A shader stage uses what it cannot.",
            Rule::Uniformity => {
                "Derivatives, implicit levels, barriers and subgroup operations need uniform control flow."
            }
            Rule::Alias => "Two names of one memory are used together, and one of them is written.",
            Rule::Operator => "Operators are mixed that WGSL has no order for.",
            Rule::Constant => {
                "A constant expression has no value of its type, or there is none where one has to be."
            }
            Rule::Override => {
                "No value was found with which an override without a default is valid."
            }
            Rule::Backend => "The shader cannot be written for a backend.",
        }
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
