#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes a virtual environment with another bpy than the project's: `bpy_environment.sh 4.2.0`.
# Prints the path of its Python on stdout. JANUS_CACHE says where it is kept; about 1 GB and a
# minute, once per machine. JANUS_PYTHON: the Python 3.11 to make it from.
# Exit code 2: it cannot be made here (the reason is on stderr).
set -eu

cache=${JANUS_CACHE:-${HOME:-/root}/.cache/janus}
version=${1:?usage: bpy_environment.sh VERSION}
dir=$cache/bpy-$version

say() { echo "bpy $version: $*" >&2; }

mkdir -p "$cache"
exec 9>"$dir.lock"
flock 9 # two test runs at once: the second waits and then finds it done
if [ -x "$dir/bin/python" ]; then
  echo "$dir/bin/python"
  exit 0
fi

say "making $dir (about 1 GB, a minute)"
python=${JANUS_PYTHON:-python3.11}
new=$dir.new # renamed at the end, so that a broken one never looks like a good one
rm -rf "$new"
if ! "$python" -m venv "$new" >&2; then
  say "needs a Python 3.11 that can make virtual environments: JANUS_PYTHON names it"
  exit 2
fi
if ! "$new/bin/python" -m pip install --quiet --disable-pip-version-check "bpy==$version" >&2; then
  say "pip cannot install it"
  exit 2
fi
mv "$new" "$dir" # nothing is called by the scripts in bin/, which name the old folder
say "ready"
echo "$dir/bin/python"
