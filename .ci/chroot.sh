#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes a chroot with another Debian, once per machine, and prints its path on stdout:
# `chroot.sh NAME SUITE FILE PACKAGE,PACKAGE...`; FILE is what is in it when it is complete.
#
# Needs root (sudo -n is tried) and mmdebstrap. JANUS_CACHE says where it is kept.
# Exit code 2: it cannot be used here (the reason is on stderr).
set -eu

if [ $# != 4 ]; then
  echo 'usage: chroot.sh NAME SUITE FILE PACKAGE,PACKAGE...' >&2
  exit 1
fi
suite=$2 file=$3 packages=$4
cache=${JANUS_CACHE:-${HOME:-/root}/.cache/janus}
dir=$cache/$1

say() { echo "chroot $suite: $*" >&2; }

if [ "$(id -u)" = 0 ]; then
  root=
elif sudo -n true 2>/dev/null; then
  root='sudo -n'
else
  say "needs root (to chroot), or a sudo that asks for no password"
  exit 2
fi
if [ -e "$dir$file" ]; then
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
exec 9>"$dir.lock"
flock 9 # two test runs at once: the second waits and then finds it done
if [ -e "$dir$file" ]; then
  echo "$dir"
  exit 0
fi

new=$dir.new # renamed at the end, so that a broken build never looks like a good one
say "building $dir (some minutes)"
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
  --include="$packages" \
  "$suite" "$new" "$mirror" >&2
$root rm -rf "$dir"
$root mv "$new" "$dir"
say "ready"
echo "$dir"
