//! Numbers that stand in WGSL, read from there while the crate is compiled.

/// The value of `const <name>: <type> = <number>;` in the text of a module. Does not compile if it is missing.
pub(crate) const fn number(text: &str, name: &str) -> f64 {
    let [value] = numbers(text, name);
    value
}

/// The first numbers in the value of a constant, names left out: for `Bias(TARGET, 1e-4)` it is 1e-4. Does not compile if
/// there are fewer.
pub(crate) const fn numbers<const N: usize>(text: &str, name: &str) -> [f64; N] {
    let bytes = text.as_bytes();
    let mut at = after(bytes, 0, b"const ", name.as_bytes());
    while bytes[at] != b'=' {
        at += 1;
    }
    let mut values = [0.0; N];
    let mut found = 0;
    while found < N {
        at += 1;
        assert!(bytes[at] != b';', "the constant has fewer numbers");
        let starts = !is_word(bytes[at - 1]) && bytes[at].is_ascii_digit();
        if starts {
            values[found] = literal(bytes, at);
            found += 1;
            while bytes[at + 1] == b'.' || bytes[at + 1] == b'-' || is_word(bytes[at + 1]) {
                at += 1;
            }
        }
    }
    values
}

const fn is_word(byte: u8) -> bool {
    byte == b'_' || byte.is_ascii_alphanumeric()
}

/// The first place after `keyword` and `name` with a colon behind them.
const fn after(bytes: &[u8], start: usize, keyword: &[u8], name: &[u8]) -> usize {
    let length = keyword.len() + name.len();
    let mut at = start;
    loop {
        assert!(at + length < bytes.len(), "the module has no such constant");
        let mut same = 0;
        while same < length {
            let expected = if same < keyword.len() {
                keyword[same]
            } else {
                name[same - keyword.len()]
            };
            if bytes[at + same] != expected {
                break;
            }
            same += 1;
        }
        if same == length && bytes[at + length] == b':' {
            return at + length;
        }
        at += 1;
    }
}

/// A decimal number of at most 15 digits, with a suffix or without.
const fn literal(bytes: &[u8], start: usize) -> f64 {
    let mut at = start;
    let mut digits: f64 = 0.0;
    let mut exponent: i32 = 0;
    let mut fraction = false;
    loop {
        let byte = bytes[at];
        match byte {
            b'0'..=b'9' => {
                digits = 10.0 * digits + (byte - b'0') as f64;
                if fraction {
                    exponent -= 1;
                }
            }
            b'.' => fraction = true,
            b'e' => {
                let negative = bytes[at + 1] == b'-';
                let power = literal(bytes, at + if negative { 2 } else { 1 }) as i32;
                exponent += if negative { -power } else { power };
                break;
            }
            b'u' | b'i' | b'f' | b'h' | b';' | b',' | b')' | b' ' => break,
            _ => panic!("the constant is no decimal number"),
        }
        at += 1;
    }
    // One rounding: up to 15 digits and 22 powers of ten are exact.
    let mut scale: f64 = 1.0;
    let mut power = 0;
    while power < exponent.abs() {
        scale *= 10.0;
        power += 1;
    }
    if exponent < 0 {
        digits / scale
    } else {
        digits * scale
    }
}

#[cfg(test)]
mod tests {
    use super::{number, numbers};

    #[test]
    fn decimal_numbers_are_read_as_the_compiler_reads_them() {
        let text = "const A_B: u32 = 7u;\nconst A: f32 = 4.1e-7; // const B\nconst B: i32 = 64;\n";
        assert_eq!(number(text, "A"), 4.1e-7);
        assert_eq!(number(text, "A_B"), 7.0);
        assert_eq!(number(text, "B"), 64.0);
        let text = "const X_1: Bias2 = Bias2(6e-5, 0.628,\n    Y_3, 0.5);";
        assert_eq!(numbers::<3>(text, "X_1"), [6e-5, 0.628, 0.5]);
    }
}
