//! What executes an instruction.

/// The unit that an instruction keeps busy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Arithmetic of every invocation.
    Valu,
    /// Arithmetic of a wave, and branches.
    Salu,
    /// Loading from and sampling textures.
    Texture,
    /// Loading from buffers, by every invocation or once per wave.
    Memory,
    /// Workgroup memory.
    Lds,
    /// Stores to textures and buffers, and exports to targets.
    Store,
    /// Waiting, hints and the end: of no unit.
    Control,
}

/// Scalar mnemonics that compute nothing.
const CONTROL: [&str; 10] = [
    "s_waitcnt",
    "s_nop",
    "s_endpgm",
    "s_clause",
    "s_inst_prefetch",
    "s_code_end",
    "s_delay_alu",
    "s_sendmsg",
    "s_setprio",
    "s_barrier",
];

impl Class {
    /// The class of a mnemonic; `None` if the instruction set does not have it.
    #[must_use]
    pub fn of(mnemonic: &str) -> Option<Class> {
        let (family, rest) = mnemonic.split_once('_').unwrap_or((mnemonic, ""));
        Some(match family {
            "v" => Class::Valu,
            "s" if CONTROL.iter().any(|name| mnemonic.starts_with(name)) => Class::Control,
            "s" if rest.starts_with("load") || rest.starts_with("buffer_load") => Class::Memory,
            "s" => Class::Salu,
            "image" if rest.starts_with("store") => Class::Store,
            "image" => Class::Texture,
            "buffer" | "tbuffer" | "global" | "flat" | "scratch" => {
                let store = rest.starts_with("store") || rest.starts_with("atomic");
                if store { Class::Store } else { Class::Memory }
            }
            "ds" | "lds" => Class::Lds,
            "exp" | "export" => Class::Store,
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_family_has_its_class() {
        let cases = [
            ("v_fma_f32", Class::Valu),
            ("v_interp_p2_f32_e32", Class::Valu),
            ("s_and_b64", Class::Salu),
            ("s_cbranch_scc1", Class::Salu),
            ("s_waitcnt_vscnt", Class::Control),
            ("s_load_dwordx8", Class::Memory),
            ("s_buffer_load_dwordx4", Class::Memory),
            ("buffer_load_dword", Class::Memory),
            ("global_store_dword", Class::Store),
            ("image_sample_lz", Class::Texture),
            ("image_load", Class::Texture),
            ("image_store", Class::Store),
            ("ds_read_b128", Class::Lds),
            ("exp", Class::Store),
        ];
        for (mnemonic, class) in cases {
            assert_eq!(Class::of(mnemonic), Some(class), "{mnemonic}");
        }
        assert_eq!(Class::of("frobnicate"), None);
    }
}
