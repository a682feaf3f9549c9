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

# shaded FILE TECHNIQUE STORAGE MAP FILTER SHADE SLOT: the technique's map through the filter node, whose output MAP goes to the slot of
# the shading node.
shaded() {
  local technique=$2 storage=$3 map=$4 filter=$5 shade=$6 slot=$7
  cat > "$graph" <<JSON
{ "version": 2, $(imports 4),
  "nodes": [
    { "name": "resolve", "type": "resolve", "properties": { "technique": "${technique#soft }", "storage": "$storage" } },
    { "name": "${map%.*}", $filter },
    { "name": "shade", "type": "$shade" }
  ],
  "edges": [
    { "from": "light_depth", "to": "resolve.depth" },
    { "from": "resolve.map", "to": "${map%.*}.map" },
    { "from": "$map", "to": "shade.$slot" },
    { "from": "camera_depth", "to": "shade.camera_depth" }
  ],
  "outputs": [{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }] }
JSON
  compile "$1" "$technique" "$storage" "$map"
}

# hard TECHNIQUE STORAGE
hard() {
  shaded "$1_$2.json" "$1" "$2" blur.blurred '"type": "blur", "properties": { "kernel": { "radius": 3 } }' shade_hard map
}

# soft TECHNIQUE STORAGE
soft() {
  shaded "soft_$1_$2.json" "soft $1" "$2" sum.table '"type": "summed_area_table", "properties": { "largest_kernel": 65 }' shade_soft table
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
