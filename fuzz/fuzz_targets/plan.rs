//! `cargo fuzz run plan`: the inputs and mutations of `moment_shadows_fuzz::plan`, guided by libFuzzer.
#![cfg_attr(fuzzing, no_main)]

moment_shadows_fuzz::guided!(plan);
