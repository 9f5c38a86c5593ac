#!/usr/bin/env bash
# Runs CalculiX's own decks on the release build and writes CCX.md beside this script: ccx_table.sh SHARED, the folder that holds
# cases/ccx and tools/compare_dat.py.
set -euo pipefail

here="$(cd "$(dirname "$0")" && pwd)"
build="$here/../../build/release"
export OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
table="$(/usr/bin/python3 "$here/ccx_table.py" "$build/balocco" "${1:?folder of the decks}" "$build/ccx")"
printf '%s\n' "$table" > "$here/CCX.md"
