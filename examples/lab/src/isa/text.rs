//! Reading the driver's disassembly.

use super::class::Class;

/// One instruction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// Its name.
    pub mnemonic: String,
    /// All that follows it.
    pub operands: String,
    /// What executes it.
    pub class: Class,
}

/// The code of a shader.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Code {
    /// The instructions, in order.
    pub instructions: Vec<Instruction>,
    /// Labels, with the index of the instruction that follows.
    pub labels: Vec<(String, usize)>,
}

/// Reads lines of the form `BB1:` and `v_add_f32_e32 v0, v1, v2  ; 06000501`. Others are remarks of the disassembler.
pub fn parse(text: &str) -> Result<Code, String> {
    let mut code = Code::default();
    for line in text.lines() {
        let line = line.split(';').next().unwrap_or_default().trim();
        if let Some(label) = line.strip_suffix(':') {
            code.labels
                .push((label.to_owned(), code.instructions.len()));
            continue;
        }
        let (mnemonic, operands) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let is_name = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_';
        if mnemonic.is_empty() || !mnemonic.bytes().all(is_name) {
            continue;
        }
        let class = Class::of(mnemonic)
            .ok_or_else(|| format!("its code has the unknown instruction '{mnemonic}'"))?;
        code.instructions.push(Instruction {
            mnemonic: mnemonic.to_owned(),
            operands: operands.trim().to_owned(),
            class,
        });
    }
    if code.instructions.is_empty() {
        return Err("its code has no instruction".to_owned());
    }
    Ok(code)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "BB0:\n\
        \ts_mov_b32 m0, s4                                            ; befc0304\n\
        \tv_interp_p1_f32_e32 v2, v0, attr0.x                         ; c8080000\n\
        BB1:\n\
        \timage_sample v[0:3], v[2:3], s[8:15], s[4:7] dmask:0xf dim:SQ_RSRC_IMG_2D ; f0800f08 00220002\n\
        \t(then repeated 2 times)\n\
        \ts_endpgm                                                    ; bf810000\n";

    #[test]
    fn instructions_and_labels_are_read() {
        let code = parse(TEXT).unwrap_or_default();
        let names: Vec<_> = code
            .instructions
            .iter()
            .map(|instruction| instruction.mnemonic.as_str())
            .collect();
        assert_eq!(
            names,
            [
                "s_mov_b32",
                "v_interp_p1_f32_e32",
                "image_sample",
                "s_endpgm"
            ]
        );
        assert_eq!(code.labels, [("BB0".to_owned(), 0), ("BB1".to_owned(), 2)]);
        assert_eq!(code.instructions[2].class, Class::Texture);
        assert!(code.instructions[2].operands.contains("dmask:0xf"));
    }

    #[test]
    fn what_is_no_code_is_an_error() {
        assert!(parse("").is_err());
        let error = parse("\tx_frobnicate v0").err().unwrap_or_default();
        assert!(error.contains("'x_frobnicate'"), "{error}");
    }
}
