//! `cargo fuzz run gltf`: the inputs and mutations of `moment_shadows_fuzz::gltf`, guided by libFuzzer.
#![cfg_attr(fuzzing, no_main)]

moment_shadows_fuzz::guided!(gltf);
