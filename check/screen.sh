# shellcheck shell=bash
# A virtual screen for programs that open windows. Sourced.

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# The screen, what finds windows, what takes and compares pictures of them, and what winit and Mesa load while they run.
need_screen() {
  # `type` asks for all of them, `command -v` for one.
  if type Xvfb xdotool import compare >/dev/null 2>&1 && ldconfig -p | grep -q libxkbcommon-x11; then return; fi
  if ! command -v apt-get >/dev/null; then
    echo "Xvfb, xdotool, ImageMagick and the X11 client libraries are needed; install them and try again." >&2
    exit 1
  fi
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends xvfb xdotool imagemagick \
    libx11-6 libx11-xcb1 libxcb1 libxcb-dri3-0 libxcb-present0 libxcb-randr0 libxcb-shm0 libxcb-sync1 libxcb-xfixes0 \
    libxcursor1 libxi6 libxkbcommon-x11-0 >/dev/null
}
