//! Random choices that are the same on every machine.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A stream of random choices.
pub struct Random(ChaCha8Rng);

impl Random {
    /// The stream of input `iteration` of the run with this seed.
    #[must_use]
    pub fn new(seed: u64, iteration: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(iteration);
        Self(rng)
    }

    /// A stream that depends on an input alone.
    #[must_use]
    pub fn of_input(data: &[u8]) -> Self {
        // FNV-1a.
        let hash = data.iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, &byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        Self::new(hash, 0)
    }

    /// A number below `limit`; 0 where the limit is 0.
    pub fn below(&mut self, limit: usize) -> usize {
        if limit == 0 {
            0
        } else {
            self.0.random_range(0..limit)
        }
    }

    /// True once in `times`.
    pub fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    /// Any 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0.random()
    }

    /// A count up to `most`, small ones as likely as large ones on a logarithmic scale.
    pub fn count(&mut self, most: usize) -> usize {
        let bits = usize::BITS - most.leading_zeros();
        let below = 1_usize << self.below(bits as usize + 1);
        self.below(below).min(most)
    }

    /// One of `items`; `None` if `items` is empty.
    pub fn pick<'a, T>(&mut self, items: &'a [T]) -> Option<&'a T> {
        items.get(self.below(items.len()))
    }

    /// One of `items`, as text.
    pub fn word(&mut self, items: &[&str]) -> String {
        self.pick(items)
            .map_or_else(String::new, |item| (*item).to_owned())
    }

    /// A part of `0..length`, mostly a short one.
    pub fn span(&mut self, length: usize) -> std::ops::Range<usize> {
        let start = self.below(length + 1);
        start..(start + self.count(length)).min(length)
    }
}
