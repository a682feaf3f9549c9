//! A glTF file taken apart: its document and its binary chunk, in one file or as text.

use serde_json::Value;

use crate::Random;
use crate::text::mutate_bytes;

/// What a file is made of.
pub(super) struct Container {
    pub(super) document: Value,
    pub(super) binary: Vec<u8>,
    /// Whether both are chunks of one binary file. As text the document names the bytes as it likes.
    pub(super) is_binary: bool,
}

const HEADER: usize = 12;

impl Container {
    /// A file that is whole.
    pub(super) fn read(data: &[u8]) -> Option<Self> {
        if !data.starts_with(b"glTF") {
            let document = serde_json::from_slice(data).ok()?;
            return Some(Self {
                document,
                binary: Vec::new(),
                is_binary: false,
            });
        }
        let (text, rest) = chunk(data.get(HEADER..)?)?;
        let binary = chunk(rest).map_or(&[][..], |(binary, _)| binary);
        Some(Self {
            document: serde_json::from_slice(text).ok()?,
            binary: binary.to_vec(),
            is_binary: true,
        })
    }

    /// The file.
    pub(super) fn write(&self) -> Vec<u8> {
        self.with_text(self.document.to_string().as_bytes())
    }

    /// The file with another text in place of its document.
    pub(super) fn with_text(&self, text: &[u8]) -> Vec<u8> {
        if !self.is_binary {
            return text.to_vec();
        }
        let mut file = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
        for (kind, bytes, fill) in [(b"JSON", text, b' '), (b"BIN\0", &self.binary, 0)] {
            let length = bytes.len().next_multiple_of(4);
            file.extend((length as u32).to_le_bytes());
            file.extend(kind);
            let end = file.len() + length;
            file.extend(bytes);
            file.resize(end, fill);
        }
        let length = file.len() as u32;
        file[8..HEADER].copy_from_slice(&length.to_le_bytes());
        file
    }

    /// A binary file whose header or chunks are wrong.
    pub(super) fn broken(mut self, random: &mut Random) -> Vec<u8> {
        self.is_binary = true;
        let mut file = self.write();
        let second = HEADER + 8 + self.document.to_string().len().next_multiple_of(4);
        // The version, the whole length, and each chunk's length and kind.
        let places = [4, 8, HEADER, HEADER + 4, second, second + 4];
        let at = places[random.below(places.len())];
        if let Some(number) = file.get_mut(at..at + 4) {
            let mut before = [0; 4];
            before.copy_from_slice(number);
            let before = u32::from_le_bytes(before);
            let after = match random.below(6) {
                0 => 0,
                1 => u32::MAX,
                2 => before.wrapping_add(1),
                3 => before.wrapping_sub(1),
                4 => before ^ (1 << random.below(32)),
                _ => random.below(file.len()) as u32,
            };
            file[at..at + 4].copy_from_slice(&after.to_le_bytes());
        }
        if random.once_in(4) {
            file = mutate_bytes(&file, &[], random);
        }
        file
    }
}

/// A chunk's bytes, and what follows it.
fn chunk(data: &[u8]) -> Option<(&[u8], &[u8])> {
    let length = data.get(..4)?.try_into().ok()?;
    data.get(8..)?
        .split_at_checked(u32::from_le_bytes(length) as usize)
}
