//! `cargo fuzz run graph_file`: the inputs and mutations of `moment_shadows_fuzz::graph_file`, guided by libFuzzer.
#![cfg_attr(fuzzing, no_main)]

moment_shadows_fuzz::guided!(graph_file);
