//! Optional features that a shader may use.

use core::fmt;
use core::str::FromStr;

use naga::valid::Capabilities;

use crate::nearest;

/// Features by which shaders of WebGPU are allowed more, as `enable` names them, and what they are to naga.
const WEBGPU: [(&str, Capabilities); 5] = [
    ("f16", Capabilities::SHADER_FLOAT16),
    ("clip_distances", Capabilities::CLIP_DISTANCES),
    ("dual_source_blending", Capabilities::DUAL_SOURCE_BLENDING),
    ("primitive_index", Capabilities::PRIMITIVE_INDEX),
    (
        "subgroups",
        Capabilities::SUBGROUP.union(Capabilities::SUBGROUP_BARRIER),
    ),
];

/// Optional features of devices. None is the default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Features(Option<Capabilities>);

impl Features {
    /// These features and those of `other`.
    #[must_use]
    pub fn and(self, other: Features) -> Self {
        Self(Some(self.needs() | other.needs()))
    }

    /// The names that features are read from: those of WebGPU as shaders `enable` them, then naga's own in lower case.
    pub fn names() -> impl Iterator<Item = String> {
        let webgpu = WEBGPU.iter().map(|(name, _)| (*name).to_owned());
        let all = Capabilities::all();
        let native: Vec<String> = all
            .iter_names()
            .filter(|(_, it)| {
                !always().contains(*it) && !WEBGPU.iter().any(|(_, of)| of.contains(*it))
            })
            .map(|(name, _)| name.to_lowercase())
            .collect();
        webgpu.chain(native)
    }

    /// What naga wants for them.
    pub(super) fn needs(self) -> Capabilities {
        self.0.unwrap_or(Capabilities::empty())
    }

    /// What naga may accept with these features.
    pub(super) fn capabilities(self) -> Capabilities {
        always() | self.needs()
    }
}

/// The names of what naga wants, quoted.
pub(super) fn names_of(needed: Capabilities) -> String {
    let webgpu = WEBGPU.iter().filter(|(_, of)| of.intersects(needed));
    let mut names: Vec<String> = webgpu
        .clone()
        .map(|(name, _)| format!("`{name}`"))
        .collect();
    let known = webgpu.fold(Capabilities::empty(), |all, (_, of)| all | *of);
    let native = (needed - known).iter_names();
    names.extend(native.map(|(name, _)| format!("`{}`", name.to_lowercase())));
    names.join(", ")
}

/// What naga takes for optional and every WebGPU device has: sample shading, cube array textures, packing of 16-bit floats, and external
/// textures; and what the profile decides elsewhere: formats of storage textures.
fn always() -> Capabilities {
    Capabilities::MULTISAMPLED_SHADING
        | Capabilities::CUBE_ARRAY_TEXTURES
        | Capabilities::SHADER_FLOAT16_IN_FLOAT32
        | Capabilities::TEXTURE_EXTERNAL
        | Capabilities::STORAGE_TEXTURE_16BIT_NORM_FORMATS
}

/// A name that is no feature's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownFeature {
    name: String,
}

impl core::error::Error for UnknownFeature {}

impl fmt::Display for UnknownFeature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<String> = Features::names().collect();
        let nearest = nearest(&self.name, names.iter().map(String::as_str));
        write!(
            f,
            "there is no feature `{}`; the nearest are {nearest}",
            self.name
        )
    }
}

/// One feature by its name.
impl FromStr for Features {
    type Err = UnknownFeature;

    fn from_str(name: &str) -> Result<Self, UnknownFeature> {
        if let Some((_, of)) = WEBGPU.iter().find(|(known, _)| *known == name) {
            return Ok(Self(Some(*of)));
        }
        let native = Features::names().any(|known| known == name);
        let found = Capabilities::from_name(&name.to_uppercase()).filter(|_| native);
        found
            .map(|it| Self(Some(it)))
            .ok_or_else(|| UnknownFeature {
                name: name.to_owned(),
            })
    }
}
