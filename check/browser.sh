#!/usr/bin/env bash
# The pages of examples/hosts/web in headless Chromium: every control by keyboard, the picture beside the native one, a phone's screen, what
# goes wrong in words, and how long pages take to load. The pictures stay in the folder check/browser of the target folder, to be looked at.
#
# usage: browser.sh [CHECK...]
# CHECK is controls, natively, phone, troubles or loading; without it, all of them.
set -euo pipefail
cd "$(dirname "$0")/.."

target=${CARGO_TARGET_DIR:-target}
# With the features of the tests, so that no crate is compiled again.
cargo build --release --locked --workspace --example hard_shadows --example web_page --bin moment-shadows
if [ ! check/node_modules/.package-lock.json -nt check/package-lock.json ]; then
  (cd check && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
fi
node --import ./check/import_map.mjs check/browser/browser.mjs "$target/check/browser" "$target/release/moment-shadows" \
  "$target/release/examples/web_page" "$@"
