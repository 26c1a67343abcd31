#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Within mounts of its own (deb.sh): an upper layer above the root LOWER, in which apt installs the
# packages of FOLDER, in_root.sh uses them and apt removes them. Nothing may be left in the layer then but
# what apt, dpkg and man keep for themselves.
#   above.sh LOWER FOLDER KIND MODULE       KIND: --clean, or "": without network (deb.sh)
set -euo pipefail
lower=$1 folder=$2 kind=$3 module=$4
top=$(mktemp -d)
mount -t tmpfs tmpfs "$top"
mkdir "$top"/{upper,work,root}
mount -t overlay overlay -o "lowerdir=$lower,upperdir=$top/upper,workdir=$top/work" "$top/root" || {
  echo "LEFT OUT: the packages are neither installed nor removed: no overlay can be mounted here"
  exit 77
}
root=$top/root
for mounted in proc sys dev; do mount --rbind "/$mounted" "$root/$mounted"; done
mount -t tmpfs tmpfs "$root/tmp"
mount -t tmpfs tmpfs "$root/run"
mkdir "$root/tmp/debs"
mount --bind "$folder" "$root/tmp/debs"
if [ "$kind" = --clean ]; then
  cp --remove-destination /etc/resolv.conf "$root/etc/resolv.conf"
fi

in_root() { # COMMAND..., of the user $as
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/tmp LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}" chroot ${as:+"--userspec=$as"} "$root" "$@"
}
# Pages of man and documents also where an image of Debian leaves them out.
apt() {
  in_root apt-get -q -y -o Dpkg::Options::=--path-include='/usr/share/man/*' \
    -o Dpkg::Options::=--path-include='/usr/share/doc/*' -o APT::Sandbox::User=root "$@" >"$top/apt.log" 2>&1 || {
    cat "$top/apt.log"
    return 1
  }
}
ours() { # what is in the upper layer and not below, nor of apt, dpkg and man themselves
  (cd "$top/upper" && find . -mindepth 1 \( -path ./var/lib/dpkg -o -path ./var/lib/apt -o -path ./var/log \
    -o -path ./var/cache -o -path ./run -o -path ./tmp -o -path ./etc/ld.so.cache \) -prune -o -print) |
    while read -r name; do
      # A folder that is in both, or the same file, was only touched.
      [ -d "$lower/$name" ] && [ -d "$top/upper/$name" ] || cmp -s "$lower/$name" "$top/upper/$name" || echo "$name"
    done | sort
}

debs=()
for deb in "$folder"/*.deb; do debs+=("/tmp/debs/${deb##*/}"); done
put_in() { apt install --no-install-recommends "${debs[@]}"; }
take_out() { apt purge rondo-dev rondo; }

if [ "$kind" = --clean ]; then # what the packages need comes, and stays: that is not ours
  apt update
  put_in
  take_out
fi
ours >"$top/before"
put_in
in_root dpkg -s rondo | grep -q '^Status: install ok installed'
as=nobody:nogroup in_root bash /tmp/debs/in_root.sh "$module" # Gmsh's libraries write to /etc where they may
echo "installed files: $(in_root dpkg -L rondo rondo-dev | sort -u | wc -l)"
take_out
ours >"$top/after"
diff "$top/before" "$top/after" || { echo "FAILED: the files above were not there before, and are left"; exit 1; }
! grep rondo "$top/after" || { echo "FAILED: the files above are left"; exit 1; }
echo "removed: nothing is left"
