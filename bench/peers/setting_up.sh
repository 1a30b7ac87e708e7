# What the benches against other engines share; sourced from the top of the tree.

# The peer's package where its command is missing, and the programs of the bench.
set_up_peer() {  # COMMAND PACKAGE TARGET...
  . packaging/set_up.sh
  if ! command -v "$1" >/dev/null; then
    local -a as_root=()
    [ "$(id -u)" -eq 0 ] || as_root=(sudo)
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$2" >&2
  fi
  shift 2
  set_up build python check >&2
  cmake --preset release >/dev/null
  cmake --build --preset release --target "$@" -j "$(nproc)" >/dev/null
  mkdir -p build/bench/peers
}

# The file of the bed, settled where there is none yet.
bed_of_peers() {
  local bed=${BED:-build/bench/peers/bed.lammps}
  [ -s "$bed" ] || build/release/peer_bed make "$bed"
  echo "$bed"
}

# Runs `ours CORES` and `theirs CORES` REPEATS times, in turn.
alternately() {  # TABLE
  : >"$1"
  local k cores
  for ((k = 1; k <= REPEATS; ++k)); do
    for cores in 1 2; do
      ours "$cores" | tee -a "$1"
      theirs "$cores" | tee -a "$1"
    done
  done
}
