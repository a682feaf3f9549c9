#!/usr/bin/env bash
# Plans in a frame graph that is not ours, on another wgpu: builds examples/hosts/frame_graph, tests it, draws its graphs, draws the
# same plans with our recorder in a process of its own, and compares pictures, order and memory. The files stay in the folder
# check/frame_graph of the target folder.
set -euo pipefail
cd "$(dirname "$0")/.."

out=$(realpath -m "${CARGO_TARGET_DIR:-target}")/check/frame_graph
mkdir -p "$out"
rm -rf "$out/drawn"
mkdir "$out/drawn"
# Its own target folder: its dependencies are others than those of the workspace.
cargo=(--release --locked --manifest-path examples/hosts/frame_graph/Cargo.toml --target-dir "$out/target")
cargo test --quiet "${cargo[@]}"
cargo run --quiet "${cargo[@]}" -- "$out/drawn"
cargo run --quiet "${cargo[@]}" --package moment-shadows-plan-recorder -- "$out/drawn"
echo "lines of the adapter: $(wc -l <examples/hosts/frame_graph/src/adapter.rs)"
