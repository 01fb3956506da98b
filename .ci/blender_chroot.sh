#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes a chroot that holds a real Blender and prints its path on stdout: `blender_chroot.sh [SUITE]`.
# SUITE is Debian's: sid (the default, Blender 5.2) or trixie (Blender 4.3). 1-2 minutes and about
# 1.2 GB each, once per machine. Exit codes and needs are those of chroot.sh.
#
# The bpy module from PyPI is no substitute: it is loaded with RTLD_LOCAL, so it cannot show a clash
# between Blender's Embree, TBB or OpenEXR and ours. A `blender` binary can.
set -eu

suite=${1:-sid}
case $suite in
  sid | trixie) ;;
  *)
    echo "usage: blender_chroot.sh [sid | trixie]" >&2
    exit 1
    ;;
esac
exec "$(dirname "$0")/chroot.sh" "blender-$suite" "$suite" /usr/bin/blender \
  blender,python3-numpy,python3-cattr,python3-requests,libgl1-mesa-dri,libegl1,libegl-mesa0,libgl1,ca-certificates
