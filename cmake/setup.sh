# SPDX-License-Identifier: BSD-3-Clause
# Sourced by scenes/run, tests/run and .ci/run: installs what a bare Debian 12 lacks, then offers `build PRESET`.
# Exports NCSIM_CORPUS (default: ../shared/corpus beside the checkout, when it is there).
set -eu

NCSIM_PACKAGES="g++ cmake ninja-build libeigen3-dev libfcl-dev libassimp-dev liburdfdom-dev
  libtinyxml2-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libtbb-dev libxxhash-dev libsqlite3-dev zlib1g-dev libjs-three
  libgtest-dev libgmock-dev libbenchmark-dev"
# Programs that tests run beside ncsim.
NCSIM_TEST_PACKAGES="linuxcnc-uspace chromium libxml2-utils slurm-wlm munge"

install_packages() {
  missing=""
  for package in "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
      missing="$missing $package"
  done
  [ -z "$missing" ] && return 0
  if [ "$(id -u)" -eq 0 ]; then as_root=""; else as_root="sudo"; fi
  echo "installing:$missing" >&2
  export DEBIAN_FRONTEND=noninteractive
  # A list that is out of date names files that are gone: update first, once.
  $as_root apt-get update -qq >&2
  # shellcheck disable=SC2086
  $as_root apt-get install -y -qq --no-install-recommends $missing >&2
}

if [ -z "${NCSIM_CORPUS:-}" ] && [ -d ../shared/corpus ]; then
  NCSIM_CORPUS=$(cd ../shared/corpus && pwd)
fi
[ -z "${NCSIM_CORPUS:-}" ] || export NCSIM_CORPUS

# build PRESET [TARGET...]: configures and builds with a preset of CMakePresets.json, quietly unless it fails.
build() {
  preset=$1
  shift
  cmake --preset "$preset" >/tmp/ncsim-configure.$$ 2>&1 || { cat /tmp/ncsim-configure.$$ >&2; return 1; }
  rm -f /tmp/ncsim-configure.$$
  if [ $# -gt 0 ]; then
    cmake --build --preset "$preset" --target "$@"
  else
    cmake --build --preset "$preset"
  fi
}
