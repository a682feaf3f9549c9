//! What the library crates and the lab read, graph files, plans, shaders and glTF files, fed with whatever a file may hold: nothing panics, hangs or leaves a file behind.
//!
//! A [`Target`] has inputs to start from, mutations that know the format, and a function that tries an input out and
//! panics where an invariant is broken. The same targets run in two ways: `cargo run -p moment-shadows-fuzz` on stable
//! Rust, seeded and bounded, and `cargo fuzz run TARGET`, guided by libFuzzer.

pub mod gltf;
pub mod graph_file;
mod json;
pub mod plan;
mod random;
pub mod runner;
mod text;
pub mod wgsl;

pub use random::Random;

/// Changes an input so many times; the seeds are what it may take parts from.
pub type Mutate = fn(&[u8], &[Vec<u8>], usize, &mut Random) -> Vec<u8>;

/// Something that reads untrusted input.
pub struct Target {
    /// Its name, on command lines and in reports.
    pub name: &'static str,
    /// Inputs to start from.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// Changes an input, with knowledge of its format.
    pub mutate: Mutate,
    /// Reads an input, and says whether it is a valid one. Panics where something is wrong.
    pub try_out: fn(&[u8]) -> bool,
}

/// All targets.
pub const TARGETS: [&Target; 4] = [
    &graph_file::TARGET,
    &plan::TARGET,
    &gltf::TARGET,
    &wgsl::TARGET,
];

/// The largest input that is made.
pub const LARGEST_INPUT: usize = 1 << 20;

impl Target {
    /// Input number `iteration` of the run with this seed: one of `seeds`, mutated a few times. Each depends on nothing
    /// but its two numbers, so that it can be made again.
    #[must_use]
    pub fn input(&self, seeds: &[Vec<u8>], seed: u64, iteration: u64) -> Vec<u8> {
        let mut random = Random::new(seed, iteration);
        let input = random.pick(seeds).map_or(&[][..], Vec::as_slice);
        // Mostly few changes: more of them seldom leave anything that gets past the first check.
        let times = 1 + random.below(8) / 2;
        let mut input = (self.mutate)(input, seeds, times, &mut random);
        input.truncate(LARGEST_INPUT);
        input
    }
}

/// The main file of a target of cargo-fuzz, which only says how it is run where cargo-fuzz does not build it.
#[macro_export]
macro_rules! guided {
    ($target:ident) => {
        #[cfg(fuzzing)]
        ::libfuzzer_sys::fuzz_target!(|data: &[u8]| {
            ($crate::$target::TARGET.try_out)(data);
        });

        #[cfg(fuzzing)]
        ::libfuzzer_sys::fuzz_mutator!(|data: &mut [u8],
                                        size: usize,
                                        max_size: usize,
                                        seed: u32| {
            if seed % 2 == 0 {
                return ::libfuzzer_sys::fuzzer_mutate(data, size, max_size);
            }
            $crate::mutate_in_place(&$crate::$target::TARGET, data, size, max_size, seed)
        });

        #[cfg(not(fuzzing))]
        fn main() {
            eprintln!(concat!(
                "run me with `cargo fuzz run ",
                stringify!($target),
                "`"
            ));
        }
    };
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
    let mutated = (target.mutate)(&data[..size], &seeds, 1, &mut random);
    let length = mutated.len().min(max_size);
    data[..length].copy_from_slice(&mutated[..length]);
    length
}
