//! `cargo fuzz run wgsl`: the inputs and mutations of `moment_shadows_fuzz::wgsl`, guided by libFuzzer.
#![cfg_attr(fuzzing, no_main)]

moment_shadows_fuzz::guided!(wgsl);
