#!/usr/bin/env bash
# Dependencies point one way: src <- partition <- contact <- solvers, and io sees src and partition only. MPI stays out of src.
set -euo pipefail
cd "$1"

declare -A sees=([src]="src" [partition]="src partition" [contact]="src partition contact" [solvers]="src partition contact solvers"
  [io]="src partition io")
wrong=0
for folder in "${!sees[@]}"; do
  headers=$(for below in ${sees[$folder]}; do (cd "$below" && find . -name '*.hpp' -printf '%P\n'); done)
  grep -rnE '^#include "' --include='*.hpp' --include='*.cpp' "$folder" | grep -v '^src/main.cpp' |
    awk -v folder="$folder" -v headers="$headers" -F'"' '
      BEGIN { count = split(headers, list, "\n"); for (i = 1; i <= count; ++i) known[list[i]] = 1 }
      !($2 in known) { sub(/#include .*/, "", $1); print $1 " " folder "/ may not include \"" $2 "\""; wrong = 1 }
      END { exit wrong }' || wrong=1
done
if grep -rnE '#include <(mpi|petsc|hdf5)' src --include='*.hpp' --include='*.cpp' | grep -v '^src/main.cpp'; then
  echo "src/ must not know MPI, PETSc or HDF5"
  wrong=1
fi
exit "$wrong"
