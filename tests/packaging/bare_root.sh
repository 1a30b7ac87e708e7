#!/bin/bash
# Installs the three Debian packages into a bare Debian 12 of its own, as a user would, and uses them there.
#   bare_root.sh PACKAGES_FOLDER SCRATCH_FOLDER
# Status 77 (skipped): not root, or no Debian mirror in reach.
set -euo pipefail
packages=$(realpath "$1") scratch=$2
[ "$(id -u)" -eq 0 ] || { echo "skipped: a bare root is made by root alone"; exit 77; }
mirror=$(apt-get indextargets --format '$(REPO_URI)' | grep -v security | head -n 1)
root=$scratch/root
rm -rf --one-file-system "$root"
mkdir -p "$root"
if ! debootstrap --variant=minbase bookworm "$root" "${mirror:-http://deb.debian.org/debian}" >"$scratch/debootstrap.log" 2>&1; then
  tail -n 5 "$scratch/debootstrap.log"
  echo "skipped: debootstrap has made no bare root; is a mirror in reach?"
  exit 77
fi
cleared() { mountpoint -q "$root/proc" && umount "$root/proc"; rm -rf --one-file-system "$root"; }
trap cleared EXIT
mount -t proc proc "$root/proc"  # the command finds its cases beside itself by /proc/self/exe
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
cp "$packages"/*.deb "$root/root/"

inside() { chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive bash -euc "cd /root; $1"; }
inside 'apt-get -qq update; apt-get -qq install -y --no-install-recommends ./*.deb >install.log 2>&1 || { tail install.log; exit 1; }'
inside 'soilbin --version; soilbin doctor | tail -n 1 | grep "All is well"'
inside 'soilbin estimate --soil dry-sand --radius 110mm --width 100mm --load 80N --slip 20% | grep "Drawbar pull"'
inside 'soilbin verify | tail -n 1'  # grains: a dozen seconds of the discrete element engine
inside 'python3 -c "import soilbin; print(soilbin.estimate(soilbin.Scenario(\"rover-wheel\", \"dry-sand\"), load=65, slip=0.2))"'
inside 'test -s /usr/share/man/man1/soilbin.1 || test -s /usr/share/man/man1/soilbin.1.gz'
inside 'soilbin init mine && head -n 1 mine/case.yaml | grep "schema=/usr/share/soilbin/schema/case.json"; test -s /usr/share/soilbin/schema/case.json'
echo "installed and used in a bare Debian 12: $(du -sm "$root" | cut -f 1) MB in all"
