#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes a chroot that holds a real Blender (Debian sid: Blender 5.2) and prints its path on stdout.
#
# The bpy module from PyPI is no substitute: it is loaded with RTLD_LOCAL, so it cannot show a clash
# between Blender's Embree, TBB or OpenEXR and ours. A `blender` binary can.
# Needs root (sudo -n is tried) and mmdebstrap; 1-2 minutes and about 1.2 GB, once per machine.
# JANUS_CACHE says where it is kept. Exit code 2: it cannot be used here (the reason is on stderr).
set -eu

cache=${JANUS_CACHE:-${HOME:-/root}/.cache/janus}
dir=$cache/blender-sid

say() { echo "blender chroot: $*" >&2; }

if [ "$(id -u)" = 0 ]; then
  root=
elif sudo -n true 2>/dev/null; then
  root='sudo -n'
else
  say "needs root (to chroot), or a sudo that asks for no password"
  exit 2
fi
if [ -x "$dir/usr/bin/blender" ]; then
  echo "$dir"
  exit 0
fi
if ! command -v mmdebstrap >/dev/null; then
  say "mmdebstrap is missing: apt-get install mmdebstrap"
  exit 2
fi

# The mirror is the one that this machine's own apt uses.
# shellcheck disable=SC2016 # apt fills in $(SITE), not the shell
# (No `exit` at the first match: that would break the pipe under apt-get.)
mirror=$(apt-get indextargets --format '$(SITE) $(ORIGIN)' 'Created-By: Packages' 2>/dev/null |
  awk '$2 == "Debian" && $1 !~ /security/ && !found { found = $1 } END { print found }')
if [ -z "$mirror" ]; then
  say "this machine's apt sources name no Debian mirror"
  exit 2
fi

mkdir -p "$cache"
exec 9>"$cache/blender-sid.lock"
flock 9 # two test runs at once: the second waits and then finds it done
if [ -x "$dir/usr/bin/blender" ]; then
  echo "$dir"
  exit 0
fi

new=$cache/blender-sid.new # renamed at the end, so that a broken build never looks like a good one
say "building $dir (Debian sid, 1-2 minutes)"
$root rm -rf --one-file-system "$new"
# Check-Valid-Until: sid's Release file is short-lived and mirrors lag behind.
# shellcheck disable=SC2086
$root mmdebstrap --variant=apt --mode=root \
  --aptopt='Acquire::Check-Valid-Until "false"' \
  --aptopt='APT::Install-Recommends "false"' \
  --dpkgopt=force-unsafe-io \
  --dpkgopt='path-exclude=/usr/share/doc/*' \
  --dpkgopt='path-exclude=/usr/share/man/*' \
  --dpkgopt='path-exclude=/usr/share/locale/*' \
  --include=blender,python3-numpy,python3-cattr,python3-requests,libgl1-mesa-dri,libegl1,libegl-mesa0,libgl1,ca-certificates \
  sid "$new" "$mirror" >&2
$root rm -rf "$dir"
$root mv "$new" "$dir"
say "ready: $($root chroot "$dir" blender --version 2>/dev/null | head -n 1)"
echo "$dir"
