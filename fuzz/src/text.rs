//! Mutations of bytes, for formats of any kind.

use crate::{LARGEST_INPUT, Random};

/// Changes some bytes: flips, removes, repeats, exchanges or inserts them.
pub(crate) fn mutate_bytes(data: &[u8], seeds: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut data = data.to_vec();
    let span = random.span(data.len());
    match random.below(7) {
        0 => {
            for _ in 0..=random.below(8) {
                let at = random.below(data.len());
                if let Some(byte) = data.get_mut(at) {
                    *byte ^= 1 << random.below(8);
                }
            }
        }
        1 => {
            data.drain(span);
        }
        2 => {
            let part = data[span.clone()].to_vec();
            let times = random.count(LARGEST_INPUT / (part.len() + 1) / 4) + 1;
            data.splice(span.end..span.end, part.repeat(times));
        }
        3 => {
            let with = random.pick(seeds).cloned().unwrap_or_default();
            let part = random.span(with.len());
            data.splice(span, with[part].iter().copied());
        }
        4 => {
            let value = [0, 1, 0x7f, 0x80, 0xff][random.below(5)];
            data[span].fill(value);
        }
        5 => data.truncate(span.start),
        _ => {
            let inserted: Vec<u8> = (0..=random.below(16))
                .map(|_| random.bits() as u8)
                .collect();
            data.splice(span.start..span.start, inserted);
        }
    }
    data
}
