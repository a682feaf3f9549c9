//! What moment-shadows reads from files, fed with whatever a file may hold: nothing panics, hangs or leaves a file behind.
//!
//! A [`Target`] has inputs to start from, mutations that know the format, and a function that tries an input out and
//! panics where an invariant is broken. The same targets run in two ways: `cargo run -p moment-shadows-fuzz` on stable
//! Rust, seeded and bounded, and `cargo fuzz run TARGET`, guided by libFuzzer.

pub mod gltf_model;
pub mod graph_file;
mod json;
pub mod models;
mod random;
pub mod runner;
mod text;
pub mod wgsl;

pub use random::Random;

/// Changes an input; the seeds are what it may take parts from.
pub type Mutate = fn(&[u8], &[Vec<u8>], &mut Random) -> Vec<u8>;

/// Something that reads untrusted input.
pub struct Target {
    /// Its name, on command lines and in reports.
    pub name: &'static str,
    /// Inputs to start from.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// Changes an input, with knowledge of its format.
    pub mutate: Mutate,
    /// Reads an input. Panics where something is wrong.
    pub try_out: fn(&[u8]),
}

/// All targets.
pub const TARGETS: [&Target; 3] = [&graph_file::TARGET, &gltf_model::TARGET, &wgsl::TARGET];

/// The largest input that is made.
pub const LARGEST_INPUT: usize = 1 << 20;

impl Target {
    /// Input number `iteration` of the run with this seed: one of `seeds`, mutated a few times. Each depends on nothing
    /// but its two numbers, so that it can be made again.
    #[must_use]
    pub fn input(&self, seeds: &[Vec<u8>], seed: u64, iteration: u64) -> Vec<u8> {
        let mut random = Random::new(seed, iteration);
        let mut input = random.pick(seeds).cloned().unwrap_or_default();
        // Mostly few changes: more of them seldom leave anything that gets past the first check.
        for _ in 0..1 + random.below(8) / 2 {
            input = (self.mutate)(&input, seeds, &mut random);
        }
        input.truncate(LARGEST_INPUT);
        input
    }
}

/// The form of mutation that libFuzzer calls: changes the first `size` bytes of `data`, to at most `max_size` of them, and
/// says how many there are now.
pub fn mutate_in_place(
    target: &Target,
    data: &mut [u8],
    size: usize,
    max_size: usize,
    seed: u32,
) -> usize {
    let mut random = Random::new(u64::from(seed), 0);
    let seeds = (target.seeds)();
    let mutated = (target.mutate)(&data[..size], &seeds, &mut random);
    let length = mutated.len().min(max_size);
    data[..length].copy_from_slice(&mutated[..length]);
    length
}
