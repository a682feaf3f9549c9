//! `cargo fuzz run graph_file`: the inputs and mutations of `moment_shadows_fuzz::graph_file`, guided by libFuzzer.
#![cfg_attr(fuzzing, no_main)]

#[cfg(fuzzing)]
libfuzzer_sys::fuzz_target!(|data: &[u8]| moment_shadows_fuzz::graph_file::try_out(data));

#[cfg(fuzzing)]
libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    if seed % 2 == 0 {
        return libfuzzer_sys::fuzzer_mutate(data, size, max_size);
    }
    moment_shadows_fuzz::mutate_in_place(
        &moment_shadows_fuzz::graph_file::TARGET,
        data,
        size,
        max_size,
        seed,
    )
});

#[cfg(not(fuzzing))]
fn main() {
    eprintln!("run me with `cargo fuzz run graph_file`");
}
