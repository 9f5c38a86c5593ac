#!/usr/bin/env bash
# Dependencies point one way: src <- partition <- contact <- solvers, and io sees src and partition only. MPI stays out of src.
set -euo pipefail
cd "$1"

declare -A sees=([src]="src" [partition]="src partition" [contact]="src partition contact" [solvers]="src partition contact solvers"
  [io]="src partition io")
wrong=0
for folder in "${!sees[@]}"; do
  while IFS=: read -r file line text; do
    header=$(sed -E 's/.*"([^"]+)".*/\1/' <<<"$text")
    found=""
    for below in ${sees[$folder]}; do [ -f "$below/$header" ] && found=yes; done
    [ -n "$found" ] || { echo "$file:$line: $folder/ may not include \"$header\""; wrong=1; }
  done < <(grep -rnE '^#include "' --include='*.hpp' --include='*.cpp' "$folder" | grep -v '^src/main.cpp')
done
if grep -rnE '#include <(mpi|petsc|hdf5)' src --include='*.hpp' --include='*.cpp' | grep -v '^src/main.cpp'; then
  echo "src/ must not know MPI, PETSc or HDF5"
  wrong=1
fi
exit "$wrong"
