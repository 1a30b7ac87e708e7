# Sourced by ./check and ./demo: installs what is missing of packaging/debian-packages.txt, and nothing else; of its
# section [unpacked] it unpacks the files below build/unpacked. A section [debian-N] is what Debian N needs besides.
# Usage: set_up SECTION...   Quiet, quick and offline where everything is there.

packages_of() {  # SECTION...: the names of the packages in these sections
  local wanted=" $* " section="" first
  while read -r first _; do
    case "$first" in
      "" | "#"*) ;;
      "["*) section="${first//[\[\]]/}" ;;
      *) [[ "$wanted" == *" $section "* ]] && echo "$first" ;;
    esac
  done < packaging/debian-packages.txt
  return 0
}

missing_of() {  # PACKAGE...: those that are not installed
  local name
  for name in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || echo "$name"
  done
}

# Packages whose files are needed and not what they depend on are unpacked, not installed.
unpack_packages() {  # [ARCHITECTURE]: the machine's own
  local name into=$PWD/build/unpacked
  for name in $(packages_of unpacked); do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null)" = installed ] && continue
    [ -e "$into/usr/share/doc/$name" ] && continue
    echo "unpacking $name into build/unpacked"
    mkdir -p "$into.new"
    (cd "$into.new" && apt-get -q download "$name${1:+:$1}" && dpkg-deb --extract "$name"_*.deb . && rm "$name"_*.deb) || return 1
    mkdir -p "$into" && cp -a "$into.new/." "$into/" && rm -r "$into.new" || return 1
  done
}

set_up() {  # SECTION...
  if ! command -v dpkg-query >/dev/null; then
    echo "set-up installs packages by apt, for Debian 12 and 13; elsewhere install what packaging/debian-packages.txt names" >&2
    return 1
  fi
  local -a as_root=() missing=($(missing_of $(packages_of "$@" "debian-$(. /etc/os-release && echo "${VERSION_ID-}")")))
  if [ ${#missing[@]} -eq 0 ]; then
    unpack_packages && echo "all packages are there"
    return
  fi
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "missing packages: ${missing[*]}; install them as root, or install sudo" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "installing ${missing[*]}"
  # A mirror that can't be reached is no obstacle where apt's lists and cache already hold what is missing.
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update || echo "apt-get update failed; going on" >&2
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" || return 1
  missing=($(missing_of "${missing[@]}"))
  [ ${#missing[@]} -eq 0 ] || { echo "still missing: ${missing[*]}" >&2; return 1; }
  unpack_packages
}
