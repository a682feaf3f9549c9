#!/usr/bin/env bash
# Compiles the plans of the page into the folder `plans`: one for every technique and storage that core WebGPU has.
#
# usage: plans.sh [COMMAND...]
# COMMAND is `moment-shadows`; without it, it is built from this checkout.
set -euo pipefail
cd "$(dirname "$0")"

command=("$@")
if [ $# = 0 ]; then
  command=(cargo run --release --locked --quiet -p moment-shadows-graph --no-default-features --features cli --)
fi
graph=$(mktemp)
trap 'rm -f "$graph"' EXIT
mkdir -p plans
listed=()

imports() {
  echo "\"imports\": [
    { \"name\": \"light_depth\", \"texture\": { \"format\": \"depth32float\", \"size\": [1024, 1024], \"samples\": $1 } },
    { \"name\": \"camera_depth\", \"texture\": { \"format\": \"depth32float\", \"size\": [1280, 720] } }
  ]"
}

# compile FILE TECHNIQUE STORAGE MAP: compiles the graph that stands in $graph, and lists it.
compile() {
  "${command[@]}" export-plan "$graph" --profile webgpu-core --compact --out "plans/$1"
  listed+=("{ \"file\": \"$1\", \"technique\": \"$2\", \"storage\": \"$3\", \"map\": \"$4\" }")
}

# hard TECHNIQUE STORAGE
hard() {
  cat > "$graph" <<JSON
{ "version": 2, $(imports 4),
  "nodes": [
    { "name": "resolve", "type": "resolve", "properties": { "technique": "$1", "storage": "$2" } },
    { "name": "blur", "type": "blur", "properties": { "kernel": { "radius": 3 } } },
    { "name": "shade", "type": "shade_hard" }
  ],
  "edges": [
    { "from": "light_depth", "to": "resolve.depth" },
    { "from": "resolve.map", "to": "blur.map" },
    { "from": "blur.blurred", "to": "shade.map" },
    { "from": "camera_depth", "to": "shade.camera_depth" }
  ],
  "outputs": [{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }] }
JSON
  compile "$1_$2.json" "$1" "$2" blur.blurred
}

# soft TECHNIQUE STORAGE
soft() {
  cat > "$graph" <<JSON
{ "version": 2, $(imports 4),
  "nodes": [
    { "name": "resolve", "type": "resolve", "properties": { "technique": "$1", "storage": "$2" } },
    { "name": "sum", "type": "summed_area_table", "properties": { "largest_kernel": 65 } },
    { "name": "shade", "type": "shade_soft" }
  ],
  "edges": [
    { "from": "light_depth", "to": "resolve.depth" },
    { "from": "resolve.map", "to": "sum.map" },
    { "from": "sum.table", "to": "shade.table" },
    { "from": "camera_depth", "to": "shade.camera_depth" }
  ],
  "outputs": [{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }] }
JSON
  compile "soft_$1_$2.json" "soft $1" "$2" sum.table
}

for storage in float16 float32; do
  for technique in hamburger4 hausdorff4 hamburger6 evsm4; do hard $technique $storage; done
done
hard hamburger6 unorm10
for technique in vsm esm evsm2; do hard $technique float32; done
soft hamburger4 float32
plans=$(printf '%s,\n' "${listed[@]}")

cat > "$graph" <<JSON
{ "version": 2, $(imports 1),
  "nodes": [{ "name": "shade", "type": "shade_hard", "properties": { "technique": { "pcf": { "gaussian": { "radius": 3, "sigma": 1.8 } } } } }],
  "edges": [{ "from": "light_depth", "to": "shade.depth" }, { "from": "camera_depth", "to": "shade.camera_depth" }],
  "outputs": [{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }] }
JSON
compile pcf.json 'percentage closer' depth light_depth
printf '{ "plans": [\n%s\n], "reference": %s }\n' "${plans%,}" "${listed[-1]}" > plans/index.json
echo "$((${#listed[@]} - 1)) plans and the reference are in $PWD/plans"
