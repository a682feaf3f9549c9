//! Storage texture formats by profile. naga accepts formats that core WebGPU refuses, so they are checked here.

use naga::common::wgsl::ToWgsl;
use naga::{ImageClass, StorageAccess, StorageFormat, TypeInner};

use crate::link::tokens::{Kind, Token, tokens};
use crate::{Linked, Profile, Rule, ShaderError};

/// Storage textures whose format or access `profile` does not have; each points at every use of it.
pub(super) fn check(module: &naga::Module, linked: &Linked, profile: Profile) -> Vec<ShaderError> {
    let mut found = Vec::new();
    for (_, ty) in module.types.iter() {
        let TypeInner::Image {
            class: ImageClass::Storage { format, access },
            ..
        } = ty.inner
        else {
            continue;
        };
        let Some(note) = objection(format, access, profile) else {
            continue;
        };
        let (format, access) = (format.to_wgsl(), access_name(access));
        let uses = uses(linked.wgsl(), format, access);
        found.push(ShaderError {
            rule: Rule::StorageFormat,
            message: format!(
                "profile `{profile}` has no storage texture of format `{format}` with access `{access}`"
            ),
            places: uses
                .iter()
                .filter_map(|token| linked.location(token.range()))
                .collect(),
            notes: vec![note.to_owned()],
        });
    }
    found
}

/// The objection to the format under the profile, with the next step.
fn objection(
    format: StorageFormat,
    access: StorageAccess,
    profile: Profile,
) -> Option<&'static str> {
    let reads_and_writes = access.contains(StorageAccess::LOAD | StorageAccess::STORE);
    if profile == Profile::NativeAdapter {
        None
    } else if access.contains(StorageAccess::ATOMIC) {
        Some("textures have no atomics in WebGPU; use a storage buffer")
    } else if is_norm16(format) && profile == Profile::WebgpuCore {
        Some(
            "16-bit normalised formats need profile `native` or `webgpu-tier1`; `rgba16float` and `rgba32float` are stored everywhere",
        )
    } else if !is_norm16(format) && !is_core(format) && !is_stored_by(format, profile) {
        Some(
            "only some adapters can store this format (profiles `native-adapter` and `webgpu-tier1`); write it in a render pass instead",
        )
    } else if reads_and_writes && !is_core_read_write(format) {
        Some(
            "only `r32uint`, `r32sint` and `r32float` can be read and written; bind a texture to read and one to write",
        )
    } else {
        None
    }
}

/// The formats that core WebGPU stores.
fn is_core(format: StorageFormat) -> bool {
    use StorageFormat as F;
    matches!(
        format,
        F::Rgba8Unorm
            | F::Rgba8Snorm
            | F::Rgba8Uint
            | F::Rgba8Sint
            | F::Rgba16Uint
            | F::Rgba16Sint
            | F::Rgba16Float
            | F::R32Uint
            | F::R32Sint
            | F::R32Float
            | F::Rg32Uint
            | F::Rg32Sint
            | F::Rg32Float
            | F::Rgba32Uint
            | F::Rgba32Sint
            | F::Rgba32Float
    )
}

/// Whether a profile beyond core WebGPU stores a format that has no 16-bit normalised channels.
fn is_stored_by(format: StorageFormat, profile: Profile) -> bool {
    use StorageFormat as F;
    match profile {
        // `texture-formats-tier1` leaves out one of WebGPU's formats, which has a feature of its own.
        Profile::WebgpuTier1 => !matches!(format, F::Bgra8Unorm | F::R64Uint),
        Profile::NativeAdapter => true,
        Profile::WebgpuCore | Profile::Native => false,
    }
}

fn is_core_read_write(format: StorageFormat) -> bool {
    use StorageFormat as F;
    matches!(format, F::R32Uint | F::R32Sint | F::R32Float)
}

/// The formats of wgpu's `TEXTURE_FORMAT_16BIT_NORM`.
fn is_norm16(format: StorageFormat) -> bool {
    use StorageFormat as F;
    matches!(
        format,
        F::R16Unorm | F::R16Snorm | F::Rg16Unorm | F::Rg16Snorm | F::Rgba16Unorm | F::Rgba16Snorm
    )
}

fn access_name(access: StorageAccess) -> &'static str {
    if access.contains(StorageAccess::ATOMIC) {
        "atomic"
    } else if access.contains(StorageAccess::LOAD | StorageAccess::STORE) {
        "read_write"
    } else if access.contains(StorageAccess::STORE) {
        "write"
    } else {
        "read"
    }
}

/// The words `format` in every `texture_storage_..<format, access>`.
fn uses<'a>(wgsl: &'a str, format: &str, access: &str) -> Vec<Token<'a>> {
    let tokens = tokens(wgsl).unwrap_or_default();
    let used = |window: &[Token<'a>]| match window {
        [texture, open, word, comma, mode]
            if texture.kind == Kind::Word
                && texture.text.starts_with("texture_storage_")
                && open.is_symbol("<")
                && word.is_word(format)
                && comma.is_symbol(",")
                && mode.is_word(access) =>
        {
            Some(*word)
        }
        _ => None,
    };
    tokens.windows(5).filter_map(used).collect()
}
