#!/usr/bin/env bash
# Makes a bare Debian 12 machine ready and builds Balocco: packages (through apt, with sudo when not root), configure, build.
# usage: source jobs/setup.sh   (defines BALOCCO_BUILD, BALOCCO_MPIRUN and PYTHON)
set -euo pipefail

balocco_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
packages=(g++ cmake ninja-build ccache pkg-config libopenmpi-dev openmpi-bin libpetsc-real-dev libslepc-real-dev libmumps-ptscotch-dev
  libhdf5-openmpi-dev hdf5-tools libopenblas0-serial libmetis-dev libeigen3-dev libcli11-dev libfmt-dev libtoml11-dev libgtest-dev libbenchmark-dev
  python3 python3-h5py python3-numpy python3-matplotlib)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  echo "Installing ${missing[*]}"
  log=$(mktemp)
  "${as_root[@]}" apt-get update -q >"$log" 2>&1 &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}" >>"$log" 2>&1 ||
    { tail -n 20 "$log"; echo "Could not install: ${missing[*]}" >&2; exit 5; }
  rm -f "$log"
fi

BALOCCO_BUILD="$balocco_root/build/release"
PYTHON=/usr/bin/python3  # Debian's own: the one that python3-h5py belongs to
# Containers run as root and often offer fewer cores than ranks; Open MPI refuses both unless told otherwise. Ranks that share
# cores must yield while they wait.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1
export OMP_NUM_THREADS=1
BALOCCO_MPIRUN=(mpirun --oversubscribe)

balocco_build() { # balocco_build [cmake arguments...]
  (cd "$balocco_root" && cmake --preset release "$@" >/dev/null && cmake --build --preset release -j "${BALOCCO_JOBS:-2}")
}
