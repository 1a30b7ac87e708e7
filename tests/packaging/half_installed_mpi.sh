#!/bin/bash
# Configures where MPI's compiler wrapper is there and its headers are not, as openmpi-bin alone leaves a machine: what is
# optional must not stop the build.
#   half_installed_mpi.sh SOURCE_FOLDER SCRATCH_FOLDER
set -euo pipefail
source=$(realpath "$1") scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch/bin" "$scratch/pkgconfig"
for name in mpicxx mpic++ mpiCC; do
  printf '#!/bin/sh\necho "-I%s/no-such-folder -L%s -lmpi_cxx -lmpi"\n' "$scratch" "$scratch" >"$scratch/bin/$name"
  chmod +x "$scratch/bin/$name"
done
IFS=: read -ra folders < <(pkg-config --variable pc_path pkg-config)
for folder in "${folders[@]}"; do
  [ ! -d "$folder" ] || find "$folder" -name '*.pc' ! -name '*mpi*' -exec ln -sf -t "$scratch/pkgconfig" {} +
done
PATH=$scratch/bin:$PATH PKG_CONFIG_LIBDIR=$scratch/pkgconfig \
  cmake --preset command -S "$source" -B "$scratch/build" >"$scratch/log" 2>&1 || { tail -n 20 "$scratch/log"; exit 1; }
grep "soilbin-lammps is left out" "$scratch/log"
