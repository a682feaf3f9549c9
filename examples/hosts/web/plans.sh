#!/usr/bin/env bash
# Compiles the plans of the pages into the folder `plans`: one for every technique and storage that core WebGPU has, and for every width of
# the blur; percentage-closer filtering of these widths, the air, and the map for three.js. The graph files stay in `plans/graphs`.
#
# usage: plans.sh [COMMAND...]
# COMMAND is `moment-shadows`; without it, it is built from this checkout.
set -euo pipefail
cd "$(dirname "$0")"

command=("$@")
if [ $# = 0 ]; then
  command=(cargo run --release --locked --quiet -p moment-shadows-graph --no-default-features --features cli --)
fi
rm -rf plans
mkdir -p plans/graphs
listed=()
widths=(1 2 3 4 5 6 7 8)

imports() {
  echo "\"imports\": [
    { \"name\": \"light_depth\", \"texture\": { \"format\": \"depth32float\", \"size\": [1024, 1024], \"samples\": $1 } },
    { \"name\": \"camera_depth\", \"texture\": { \"format\": \"depth32float\", \"size\": [1280, 720] } }
  ]"
}

# compile FILE: compiles the graph that comes in.
compile() {
  cat > "plans/graphs/$1"
  "${command[@]}" export-plan "plans/graphs/$1" --profile webgpu-core --compact --out "plans/$1"
}

# shaded FILE TECHNIQUE STORAGE MAP RADIUS FILTER SHADE SLOT: the technique's map through the filter node, whose output MAP goes to the slot
# of the shading node.
shaded() {
  local technique=$2 storage=$3 map=$4 radius=$5 filter=$6 shade=$7 slot=$8
  compile "$1" <<JSON
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
  listed+=("{ \"file\": \"$1\", \"technique\": \"$technique\", \"storage\": \"$storage\", \"map\": \"$map\", \"radius\": $radius }")
}

# hard TECHNIQUE STORAGE: with a kernel of each width. One whose weights can change per frame takes more instructions.
hard() {
  local radius
  for radius in "${widths[@]}"; do
    shaded "$1_$2_$radius.json" "$1" "$2" blur.blurred "$radius" \
      "\"type\": \"blur\", \"properties\": { \"kernel\": { \"radius\": $radius } }" shade_hard map
  done
}

# soft TECHNIQUE STORAGE: as wide as the sun makes them.
soft() {
  shaded "soft_$1_$2.json" "soft $1" "$2" sum.table null \
    '"type": "summed_area_table", "properties": { "largest_kernel": 65 }' shade_soft table
}

for storage in float16 float32; do
  for technique in hamburger4 hausdorff4 hamburger6 evsm4; do hard $technique $storage; done
done
hard hamburger6 unorm10
for technique in vsm esm evsm2; do hard $technique float32; done
soft hamburger4 float32

# What the techniques are compared with: a kernel as wide as that of the blur.
references=()
for radius in "${widths[@]}"; do
  # As of the blur: 0.6 of the radius.
  sigma=$((radius * 6 / 10)).$((radius * 6 % 10))
  compile "pcf_$radius.json" <<JSON
{ "version": 2, $(imports 1),
  "nodes": [{ "name": "shade", "type": "shade_hard", "properties": { "technique": { "pcf": { "gaussian": { "radius": $radius, "sigma": $sigma } } } } }],
  "edges": [{ "from": "light_depth", "to": "shade.depth" }, { "from": "camera_depth", "to": "shade.camera_depth" }],
  "outputs": [{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }] }
JSON
  references+=("\"$radius\": \"pcf_$radius.json\"")
done

# The air scatters what the sun's map lets through.
compile air.json <<JSON
{ "version": 2, $(imports 4),
  "nodes": [
    { "name": "resolve", "type": "resolve", "properties": { "storage": "float16" } },
    { "name": "blur", "type": "blur", "properties": { "kernel": { "radius": 2 } } },
    { "name": "rectify", "type": "rectify_moments", "properties": { "technique": "hamburger6", "storage": "float16", "extent": [512, 512] } },
    { "name": "integrate", "type": "integrate_scattering" },
    { "name": "composite", "type": "composite_scattering" }
  ],
  "edges": [
    { "from": "light_depth", "to": "resolve.depth" },
    { "from": "resolve.map", "to": "blur.map" },
    { "from": "blur.blurred", "to": "rectify.map" },
    { "from": "camera_depth", "to": "rectify.camera_depth" },
    { "from": "rectify.rectified", "to": "integrate.rectified" },
    { "from": "rectify.view_rays", "to": "integrate.view_rays" },
    { "from": "integrate.integrated", "to": "composite.integrated" },
    { "from": "camera_depth", "to": "composite.camera_depth" }
  ],
  "outputs": [{ "name": "scattering", "from": "composite.scattering" }] }
JSON

# Of the map that three.js draws, what its materials look up.
compile three.json <<JSON
{ "version": 2,
  "imports": [{ "name": "light_depth", "texture": { "format": "depth24plus", "size": [1024, 1024] } }],
  "nodes": [
    { "name": "resolve", "type": "resolve", "properties": { "storage": "float16" } },
    { "name": "blur", "type": "blur", "properties": { "kernel": { "radius": 3 }, "per_frame": true } }
  ],
  "edges": [{ "from": "light_depth", "to": "resolve.depth" }, { "from": "resolve.map", "to": "blur.map" }],
  "outputs": [{ "name": "shadow_map", "from": "blur.blurred" }] }
JSON

plans=$(printf '%s,\n' "${listed[@]}")
references=$(printf '%s, ' "${references[@]}")
printf '{ "plans": [\n%s\n],\n"references": { %s } }\n' "${plans%,}" "${references%, }" > plans/index.json
echo "${#listed[@]} plans of shadows, and what they are compared with, are in $PWD/plans"
