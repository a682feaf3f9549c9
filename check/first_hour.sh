#!/usr/bin/env bash
# The first hour of a renderer of one's own: from an empty folder, with this checkout beside it, to a picture. The renderer has what
# many have: the sun's depth as depth24plus, the camera's as depth24plus-stencil8 with four samples. Says how many names and lines the
# library takes; the picture stays in check/first_hour of the target folder.
set -euo pipefail
cd "$(dirname "$0")/.."

checkout=$PWD
out=$(realpath -m "${CARGO_TARGET_DIR:-target}")/check/first_hour
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cd "$folder"
cargo new --quiet --bin engine
cd engine
cargo add --quiet --path "$checkout/graph"
cargo add --quiet wgpu@30 glam@0.34 pollster@0.4
cargo add --quiet bytemuck@1
cargo add --quiet image@0.25 --no-default-features --features png
cp "$checkout"/check/first_hour/{main.rs,scene.wgsl,graph.json} src/
CARGO_TARGET_DIR=$out/target cargo build --quiet --release
"$out/target/release/engine"
mkdir -p "$out"
cp picture.png "$out/picture.png"

names=$(sed -n 's/^use moment_shadows_graph::{\(.*\)};/\1/p' src/main.rs)
count=$(tr ',' '\n' <<<"$names" | wc -l)
lines=$(grep -cE 'moment_shadows_graph|Graph =|let imports|session' src/main.rs)
echo "$count names of the library ($names), $lines lines of $(wc -l <src/main.rs) that name it, and a graph of $(wc -l <src/graph.json)"
echo "the picture is $out/picture.png"
