#!/usr/bin/env bash
# Runs every problem of the table on the release build and writes RESULTS.md beside this script. Arguments go to table.py.
set -euo pipefail

here="$(cd "$(dirname "$0")" && pwd)"
build="$here/../../build/release"
export OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
/usr/bin/python3 "$here/problems/table.py" "$build/balocco" "$build/results" --jobs 2 --write "$here/RESULTS.md" "$@"
