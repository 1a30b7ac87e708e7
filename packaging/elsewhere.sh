#!/usr/bin/env bash
# Builds soilbin and runs its fast tests where people have it besides Debian 12 on x86-64. As root, with a Debian mirror
# in reach; else status 77 (skipped). FOLDER, 3 to 4 GB, is kept: a second call goes on from there.
#
#   packaging/elsewhere.sh debian-13 FOLDER   in a root of its own: GCC 14, SUNDIALS 7, Highway 1.2, Python 3.13
#   packaging/elsewhere.sh arm64 FOLDER       compiled in a root of its own by Debian 12's cross compiler, run under qemu-user
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
usage="usage: packaging/elsewhere.sh debian-13|arm64 FOLDER"
where=${1-}
case $where${2:+ there} in
  "debian-13 there") suite=trixie ;;
  "arm64 there") suite=bookworm ;;
  *) echo "$usage" >&2; exit 2 ;;
esac
root=$(realpath -m "$2")
[ "$(id -u)" -eq 0 ] || { echo "skipped: another root is made by root alone"; exit 77; }

if [ ! -e "$root/soilbin" ]; then
  [ -z "$(ls -A "$root" 2>/dev/null)" ] || { echo "$root is not empty, and no root made here: name a new folder" >&2; exit 2; }
  mirror=$(apt-get indextargets --format '$(REPO_URI)' | grep -v security | head -n 1)
  if ! debootstrap --variant=minbase "$suite" "$root" "${mirror:-http://deb.debian.org/debian}"; then
    rm -rf --one-file-system "$root"
    echo "skipped: debootstrap has made no root; is a mirror in reach?"
    exit 77
  fi
fi
mkdir -p "$root/soilbin"
find "$root/soilbin" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
git -c safe.directory="$PWD" ls-files -z --cached --others --exclude-standard |
  tar --null --ignore-failed-read -T - -c | tar -x -C "$root/soilbin"
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
trap 'umount "$root/proc"' EXIT
inside() {
  chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/lib/ccache:/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive PYTHONDONTWRITEBYTECODE=1 jobs="$(nproc)" bash -euc "
      cd /soilbin
      . packaging/set_up.sh
      install() { apt-get -q install -y --no-install-recommends \"\$@\"; }
      $1"
}

# Left to ./check on the machine itself: tests of the tree, of documents and browsers, and those that take long.
labels='^(architecture|readme|install|package|slow|fuzz|attack|lammps)$'
if [ "$where" = debian-13 ]; then
  inside 'set_up build python
    install libgtest-dev libgmock-dev librapidcheck-dev git python3-scipy
    cmake --preset release -D SOILBIN_BENCHMARKS=OFF
    cmake --build --preset release -j $jobs'
  inside "ctest --test-dir build/release -j \$jobs --timeout 600 --output-on-failure --no-tests=error -LE '$labels' -E '[.]page\$|typing'"
else
  # Libraries are arm64's, tools the machine's; so the Python package, which asks for a Python of arm64, is left out.
  inside 'dpkg --add-architecture arm64
    apt-get -qq update
    install $(packages_of build | grep -v -- -dev) g++-aarch64-linux-gnu qemu-user-static git \
      $(for name in $(packages_of build | grep -e -dev) libgtest-dev libgmock-dev librapidcheck-dev; do echo $name:arm64; done)
    unpack_packages arm64
    cmake -S . -B build/arm64 -G Ninja --toolchain packaging/arm64.cmake -D CMAKE_UNITY_BUILD=ON \
      -D CMAKE_UNITY_BUILD_BATCH_SIZE=24 -D SOILBIN_BENCHMARKS=OFF -D SOILBIN_PYTHON=OFF
    cmake --build build/arm64 -j $jobs'
  # Tests start the command and what they compile by cc, so the kernel runs arm64's programs meanwhile.
  misc=/proc/sys/fs/binfmt_misc
  [ -e $misc/register ] || mount -t binfmt_misc none $misc || { echo "skipped: this kernel has no binfmt_misc"; exit 77; }
  trap 'umount "$root/proc"; [ ! -e $misc/soilbin-arm64 ] || echo -1 >$misc/soilbin-arm64' EXIT
  elf='\x7fELF\x02\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\xb7\x00'
  mask='\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff'
  [ -e $misc/soilbin-arm64 ] || echo ":soilbin-arm64:M::$elf:$mask:$root/usr/bin/qemu-aarch64-static:F" >$misc/register
  # Tests that are Python programs are the machine's, and left out.
  inside 'mkdir -p /opt/arm64 && ln -sf /usr/bin/aarch64-linux-gnu-gcc /opt/arm64/cc'
  inside "PATH=/opt/arm64:\$PATH ctest --test-dir build/arm64 -j \$jobs --timeout 1200 --output-on-failure --no-tests=error -LE '$labels' -E '^(nature|loop_bench|serve|report|site)'"
fi
