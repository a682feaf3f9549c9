# shellcheck shell=bash
# The steps of `./run check`: what judges the shaders besides our own compiler and driver. Sourced by `run`.

# What the steps fetch and write.
work=${CARGO_TARGET_DIR:-target}/check

# need_packages COMMAND PACKAGE...: installs Debian packages unless there is the command.
need_packages() {
  local command=$1
  shift
  if command -v "$command" >/dev/null; then return; fi
  if ! command -v apt-get >/dev/null; then
    echo "The command $command is needed; on Debian it is in the package $1." >&2
    exit 1
  fi
  update_packages
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

# Fetches the lists of packages, once.
update_packages() {
  if [ -z "${packages_updated:-}" ]; then as_root apt-get update -qq; fi
  packages_updated=1
}

# Every shader as WGSL, SPIR-V and GLSL, in $work/shaders.
write_shaders() {
  mkdir -p "$work"
  rm -rf "$work/shaders"
  lab shaders --out "$work/shaders"
}

# What the checks in JavaScript import.
need_npm_packages() {
  need_packages node nodejs
  need_packages npm npm
  if [ ! check/node_modules/.package-lock.json -nt check/package-lock.json ]; then
    # The package's script serves macOS alone.
    (cd check && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
  fi
}

# Tint, the compiler of Chromium, in Dawn for Node.
run_tint() {
  need_npm_packages
  node check/tint.mjs "$work/shaders"
}

# Our verdicts beside Tint's, on pairs of shaders and on shaders of published packages. Downloads are kept.
run_agreement() {
  need_npm_packages
  node check/agreement/agreement.mjs "$work/agreement" "$(built --bin moment-shadows)"
}

# A second recorder of plans, in JavaScript: its parameters beside those of the library, byte by byte, its recordings on Dawn, a picture
# beside arithmetic, and its size. The picture is SwiftShader's: this Dawn refuses older versions of Mesa's driver.
run_javascript() {
  need_npm_packages
  rm -rf "$work/plans"
  mkdir -p "$work"
  "$(built --example write_parameters)" "$work/parameters.json"
  "$(built --example write_plans)" "$work/plans"
  node check/parameters.mjs "$work/parameters.json"
  node check/plans.mjs "$work/plans"
  on_swiftshader node check/run_plan.mjs "$work/plans/webgpu-core/example hard_shadows.json"
  node check/package_size.mjs graph/js
}

# The page of examples/hosts/web: its plans, and what it draws with them.
run_page() {
  need_npm_packages
  examples/hosts/web/plans.sh "$(realpath "$(built --bin moment-shadows)")"
  on_swiftshader node --import ./check/import_map.mjs check/page.mjs
}

# Both pages in a browser. How long they take to load is a matter of an idle machine: check/browser.sh loading.
run_browser() {
  need_chromium
  need_npm_packages
  check/browser.sh controls natively phone troubles
}

# The library's npm package, in $work/npm and among the packages of the checks, and what npm's linker of WESL makes of every module
# with it. The example of its README is run too.
run_wesl_npm() {
  need_npm_packages
  node packages/npm/build.mjs "$work/npm"
  (cd "$work/npm" && npm pack --silent >/dev/null)
  local package
  package=$(realpath "$work"/npm/moment-shadows-*.tgz)
  rm -rf check/node_modules/moment-shadows
  (cd check && npm install --no-save --ignore-scripts --no-audit --no-fund --loglevel=error "$package")
  awk '/^```/ { inside = /js$/; next } inside' packages/npm/README.md |
    (cd check && node --input-type=module) >"$work/npm_readme.wgsl"
  grep -q 'fn hamburger4_shadow_intensity_of_texel' "$work/npm_readme.wgsl"
  node check/linked.mjs
  cargo test --release --locked --workspace --test wesl the_npm_package -- --ignored --nocapture
}

# The library's package for the crate `wesl`, and what the crate makes of every module with it. The crate asks for a newer Rust than
# it needs.
run_wesl_rs() {
  # Nothing here needs speed; compiling does.
  local cargo=(--locked --ignore-rust-version --manifest-path packages/wesl_rs/Cargo.toml
    --target-dir "${CARGO_TARGET_DIR:-target}/tmp/wesl_rs")
  cargo test "${cargo[@]}"
  cargo test --release --locked --workspace --test wesl the_rust_package -- --ignored --nocapture
}

# The findings of `validate` as SARIF, by the schema that a package carries.
run_sarif() {
  cargo info --quiet serde-sarif@0.8.0 >/dev/null
  local schema
  schema=$(find "${CARGO_HOME:-$HOME/.cargo}/registry/src" -path '*/serde-sarif-0.8.0/src/schema.json' | head -n 1)
  SARIF_SCHEMA=$schema cargo test --release --locked --workspace --test command sarif_by_its_schema -- --ignored
}

run_spirv_val() {
  need_packages spirv-val spirv-tools
  spirv-as --target-env vulkan1.1 check/planted/return.spvasm -o "$work/planted.spv"
  if spirv-val --target-env vulkan1.1 "$work/planted.spv" 2>/dev/null; then
    echo "spirv-val does not see the error planted in return.spvasm" >&2
    return 1
  fi
  echo "planted return.spvasm: refused, as it should be"
  local target file count=0 refused=0
  for target in vulkan1.1 vulkan1.3; do
    for file in "$work"/shaders/*."$target".spv; do
      count=$((count + 1))
      spirv-val --target-env "$target" "$file" || { echo "$file" >&2 && refused=$((refused + 1)); }
    done
  done
  echo "spirv-val: $count files, $refused refused"
  [ "$refused" = 0 ]
}

# The GLSL that validation calls good.
run_glslang() {
  need_packages glslangValidator glslang-tools
  if glslangValidator check/planted/mix.frag >/dev/null; then
    echo "glslangValidator does not see the error planted in mix.frag" >&2
    return 1
  fi
  echo "planted mix.frag: refused, as it should be"
  local target file count refused=0
  for target in 450 300es; do
    count=0
    for file in "$work"/shaders/*."$target".{vert,frag,comp}; do
      if [ ! -e "$file" ]; then continue; fi
      count=$((count + 1))
      glslangValidator "$file" || { echo "$file" >&2 && refused=$((refused + 1)); }
    done
    echo "glslangValidator: $count files for $target"
    if [ "$count" = 0 ]; then return 1; fi
  done
  echo "glslangValidator: $refused refused"
  [ "$refused" = 0 ]
}

# Slang, a compiler of HLSL: the library that a package of PyPI carries, in $work/slang.
need_slang() {
  local version=0.43.1
  if [ -e "$work/slang/slangpy-$version.dist-info" ]; then return; fi
  need_packages python3 python3
  need_packages pip3 python3-pip
  rm -rf "$work/slang"
  python3 -m pip install --quiet --no-deps --disable-pip-version-check --root-user-action=ignore \
    --target "$work/slang" "slangpy==$version"
}

# What `export` writes: GLSL by glslang and HLSL by Slang, run on the adapter beside WGSL and compared with the vectors.
run_ports() {
  need_packages glslangValidator glslang-tools
  need_slang
  rm -rf "$work/ports"
  lab ports "$work/ports"
  local file
  for file in "$work"/ports/glsl/*.comp; do
    glslangValidator -V --quiet "$file" -o "${file%.comp}.spv"
  done
  python3 check/slang.py "$work/slang" "$work/ports/hlsl"
  lab ports --compiled "$work/ports"
}

# What a compiler for GPUs makes of every shader, against the table that is kept: Mesa's driver for AMD chips compiles
# without one.
run_isa() {
  if ! compgen -G '/usr/share/vulkan/icd.d/radeon_icd*.json' >/dev/null && command -v apt-get >/dev/null; then
    update_packages
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq mesa-vulkan-drivers >/dev/null
  fi
  lab isa --check
}

# A browser, and a font for its pages.
need_chromium() {
  need_packages chromium chromium fonts-dejavu-core
}

# SwiftShader, a rasteriser that shares nothing with Mesa: its driver file. Chromium carries it.
need_swiftshader() {
  need_chromium
  swiftshader=/usr/lib/chromium/vk_swiftshader_icd.json
  if [ ! -e "$swiftshader" ]; then
    echo "SwiftShader is needed; this script finds it in Debian's package chromium only, as $swiftshader." >&2
    exit 1
  fi
}

# Runs a command whose Vulkan driver is SwiftShader.
on_swiftshader() {
  need_swiftshader
  # Two names: the second one serves loaders of Vulkan before 1.3.207.
  VK_DRIVER_FILES=$swiftshader VK_ICD_FILENAMES=$swiftshader "$@"
}

# Tests that depend on the arithmetic of shaders, and on the recorder. Tests of pictures are left out: SwiftShader places
# vertices on a grid of 1/16 of a pixel (others: 1/256), which moves a slope's depth by more than these tests allow.
numerics_on_swiftshader() {
  need_swiftshader
  # Two names: the second one serves loaders of Vulkan before 1.3.207.
  (
    export VK_DRIVER_FILES=$swiftshader VK_ICD_FILENAMES=$swiftshader
    lab adapter | tee "$work/adapter"
    if ! grep -q "^SwiftShader" "$work/adapter"; then
      echo "the adapter should be SwiftShader" >&2
      exit 1
    fi
    cargo test --release --locked --workspace --test numerics --test stability --test lookups --test vector_files --test export \
      --test quantisation --test light_leaking --test receiver_bias --test blur --test recorder \
      --test percentage_closer --test summed_area_table --test soft_shadows --test single_scattering --test scattering_error \
      --test techniques
  )
}

# Graph files, plans, glTF files and shaders that are mutated at random: the same ones each time.
run_fuzzing() {
  local bounds
  for bounds in graph_file:12000 plan:30000 gltf:2000 wgsl:800; do
    run_built --bin moment-shadows-fuzz \
      --target "${bounds%:*}" --iterations "${bounds#*:}" --seconds 120 --seed 1
  done
}

# A driver whose calls fail in turn: without memory, and with a lost device. One in forty here.
run_faults() { run_built --bin moment-shadows-faults --every 40; }

# Prints the arguments for each combination of features of the library crates, a line each.
feature_combinations() {
  local manifest package features chosen set bit
  for manifest in Cargo.toml graph/Cargo.toml; do
    package=$(sed -n 's/^name = "\(.*\)"$/\1/p' "$manifest" | head -n 1)
    mapfile -t features < <(awk '/^\[/ { inside = $0 == "[features]" } inside && /^[a-z]/ && $1 != "default" { print $1 }' "$manifest")
    for ((set = 0; set < 1 << ${#features[@]}; set++)); do
      chosen=()
      for bit in "${!features[@]}"; do
        if ((set >> bit & 1)); then chosen+=(--features "${features[bit]}"); fi
      done
      echo "-p $package --no-default-features ${chosen[*]}"
    done
  done
}

every_feature_combination() {
  local arguments
  while read -r -a arguments; do
    echo "cargo clippy ${arguments[*]}"
    cargo clippy --release --locked --quiet "${arguments[@]}" -- -D warnings
  done < <(feature_combinations)
}

# The library crates for the web. Its standard library comes from rustup.
check_wasm() {
  local target=wasm32-unknown-unknown arguments
  if [ ! -d "$(rustc --print target-libdir --target $target)" ] && ! rustup target add $target; then
    echo "NOT CHECKED: the standard library for $target is absent and cannot be fetched here."
    echo "With network access, get it by: rustup target add $target"
    return
  fi
  while read -r -a arguments; do
    echo "cargo check --target $target ${arguments[*]}"
    cargo check --release --locked --quiet --target $target "${arguments[@]}"
  done < <(feature_combinations)
}

check() {
  step "A graphics adapter" need_adapter
  step "The library crates with every combination of features" every_feature_combination
  step "The library crates for wasm32" check_wasm
  step "Every linked shader as WGSL, SPIR-V and GLSL" write_shaders
  step "A second compiler: Tint" run_tint
  step "What is ok here is ok in browsers: agreement with Tint" run_agreement
  step "A second recorder: plans and parameters in JavaScript" run_javascript
  step "A page in JavaScript" run_page
  step "Both pages in a browser: Chromium" run_browser
  step "SARIF by its schema" run_sarif
  step "WESL: the npm package, linked by npm's wesl" run_wesl_npm
  step "WESL: the Rust package, linked by the crate wesl" run_wesl_rs
  step "The SPIR-V: spirv-val" run_spirv_val
  step "The GLSL: glslang" run_glslang
  step "Other languages: exported GLSL and HLSL on the adapter" run_ports
  step "What the code costs: instructions for two AMD chips" run_isa
  step "A second rasteriser: the tests of numerics on SwiftShader" numerics_on_swiftshader
  step "A device that fails: calls of the driver without memory, or lost" run_faults
  step "Fuzzing" run_fuzzing
}
