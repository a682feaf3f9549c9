#!/usr/bin/env bash
# A host that is not ours: builds examples/egui_host, draws it without a window, opens its window on a virtual screen, and
# compares the two pictures. They stay in the folder check/egui_host of the target folder.
set -euo pipefail
cd "$(dirname "$0")/.."

out=$(realpath -m "${CARGO_TARGET_DIR:-target}")/check/egui_host
mkdir -p "$out"

# shellcheck source=check/screen.sh
source check/screen.sh
need_screen
# Its own target folder: its dependencies have other features than those of the workspace.
cargo=(--release --locked --manifest-path examples/egui_host/Cargo.toml --target-dir "$out/target")
cargo build --quiet "${cargo[@]}"
cargo test --quiet "${cargo[@]}"
cp "$out/target/tmp/egui_host.png" "$out/headless.png"

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
"$out/target/release/moment-shadows-egui-host" 2>"$out/window.log" &
processes+=($!)

# The window, and then two pictures of it that are equal: the first ones may be from before it is drawn.
window=
for _ in $(seq 120); do
  window=$(xdotool search --onlyvisible --name '^moment-shadows$' 2>/dev/null | head -n 1 || true)
  if [ -n "$window" ]; then break; fi
  if ! kill -0 "${processes[1]}" 2>/dev/null; then break; fi
  sleep 0.5
done
if [ -z "$window" ]; then
  echo "the window did not open:" >&2
  cat "$out/window.log" >&2
  exit 1
fi
rm -f "$out"/shot*.png
for _ in $(seq 60); do
  sleep 1
  import -window "$window" "$out/shot.png"
  # A window that shows nothing has few colours.
  colours=$(identify -format '%k' "$out/shot.png")
  if [ "$colours" -gt 1000 ] && [ -e "$out/shot-before.png" ] && cmp -s "$out/shot.png" "$out/shot-before.png"; then break; fi
  cp "$out/shot.png" "$out/shot-before.png"
done
if [ -s "$out/window.log" ]; then cat "$out/window.log" >&2; fi

# The same picture in a window of another size: both panes are cut out and brought to one size. Edges are filtered
# differently then, and what egui shows behind the sky is darker; without shadows the difference is three times the limit.
width=$(identify -format '%w' "$out/shot.png")
convert "$out/shot.png" -crop "${width}x$((width * 9 / 16))+0+0" +repage -resize '480x270!' "$out/shot-small.png"
convert "$out/headless.png" -crop 960x540+8+8 +repage -resize '480x270!' "$out/headless-small.png"
difference=$(compare -metric RMSE "$out/shot-small.png" "$out/headless-small.png" null: 2>&1 | sed 's/.*(\(.*\)).*/\1/' || true)
echo "the window differs from the picture without a window by $difference (root mean square, of 1); both are in $out"
if ! awk -v difference="$difference" 'BEGIN { exit !(difference != "" && difference + 0 < 0.05) }'; then
  echo "which is more than 0.05" >&2
  exit 1
fi
