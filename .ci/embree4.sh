#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the core against Embree 4 in a chroot (Debian trixie; Debian 12, where we build, has
# Embree 3) and runs its tests there: `embree4.sh [OPTION OF CTEST...]`.
#
# The chroot, with a copy of the sources and the build, is JANUS_CACHE/embree4: about 1 GB.
# Exit code 2: it cannot be used here (the reason is on stderr).
set -eu

here=$(cd "$(dirname "$0")" && pwd)
jobs=${JANUS_JOBS:-$(nproc)}
chroot=$("$here/chroot.sh" embree4 trixie /usr/bin/ninja \
  build-essential,cmake,ninja-build,ccache,libembree-dev,libglm-dev,libopenexr-dev,libgtest-dev)
root=
[ "$(id -u)" = 0 ] || root='sudo -n'
if ! $root unshare --mount --pid --fork --mount-proc="$chroot/proc" true; then
  echo "Embree 4: processes here cannot have a /proc of their own" >&2
  exit 2
fi

exec 9>"$chroot.lock"
flock 9 # two runs at once: one build

# Anew: other clones have been built here, and the dates of files say nothing about whose are newer.
# What has not changed comes from ccache.
$root rm -rf "$chroot/janus"
$root mkdir -p "$chroot/janus"
(cd "$here/.." && tar -c --exclude='__pycache__' CMakeLists.txt CMakePresets.json LICENSE \
  addon/blender_manifest.toml core tests/core tests/bench) |
  $root tar -x --no-same-owner -C "$chroot/janus"

# inside COMMANDS. A mount of /proc of its own, which ends with the processes: tests look at their
# memory there.
inside() {
  $root unshare --mount --pid --fork --mount-proc="$chroot/proc" chroot "$chroot" \
    /usr/bin/env -i PATH=/usr/bin:/bin HOME=/root LC_ALL=C.UTF-8 sh -euc "cd /janus; $1"
}
inside "cmake --preset release --log-level=STATUS -DJANUS_BUILD_PYTHON=OFF | grep 'Embree 4'
  nice cmake --build build/release --parallel $jobs --target janus_tests
  nice ctest --preset release --parallel $jobs --timeout 1200 --no-tests=error $*" || exit 1
