#!/usr/bin/env bash
# Bevy as a host: builds examples/hosts/bevy, tests it (pictures beside Bevy's own filter and fog, with numbers), and opens its window on a
# virtual screen. The pictures stay in the folder check/bevy_host of the target folder. Bevy takes minutes to compile, once.
set -euo pipefail
cd "$(dirname "$0")/.."

out=$(realpath -m "${CARGO_TARGET_DIR:-target}")/check/bevy_host
mkdir -p "$out"
rm -rf "$out"/target/tmp

# shellcheck source=check/screen.sh
source check/screen.sh
need_screen
# Its own target folder: its dependencies are others than those of the workspace. Bevy names a newer Rust than it needs.
cargo=(--release --locked --ignore-rust-version --manifest-path examples/hosts/bevy/Cargo.toml --target-dir "$out/target")
cargo build --quiet "${cargo[@]}"
# One after the other: frame times are compared.
cargo test --quiet "${cargo[@]}" -- --test-threads 1 --nocapture
mkdir -p "$out/pictures"
mv "$out"/target/tmp/*.png "$out/pictures"
echo "lines of the adapter's node part: $(wc -l <examples/hosts/bevy/src/node.rs)"

processes=()
trap 'kill "${processes[@]}" 2>/dev/null || true' EXIT
Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp 3>"$out/display" 2>"$out/xvfb.log" &
processes+=($!)
for _ in $(seq 100); do
  if [ -s "$out/display" ]; then break; fi
  sleep 0.1
done
DISPLAY=:$(cat "$out/display")
export DISPLAY
unset WAYLAND_DISPLAY
"$out/target/release/moment-shadows-bevy" --graph examples/hosts/bevy/graphs/hamburger4.json 2>"$out/window.log" &
processes+=($!)
# A window that shows nothing has few colours.
colours=0
for _ in $(seq 120); do
  window=$(xdotool search --onlyvisible --name '^moment-shadows$' 2>/dev/null | head -n 1 || true)
  if [ -n "$window" ]; then
    import -window "$window" "$out/pictures/window.png"
    colours=$(identify -format '%k' "$out/pictures/window.png")
    if [ "$colours" -gt 500 ]; then break; fi
  fi
  if ! kill -0 "${processes[1]}" 2>/dev/null; then break; fi
  sleep 0.5
done
if [ "$colours" -le 500 ]; then
  echo "the window shows nothing:" >&2
  cat "$out/window.log" >&2
  exit 1
fi
echo "the window shows $colours colours; pictures are in $out/pictures"
