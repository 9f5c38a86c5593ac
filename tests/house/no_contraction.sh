#!/usr/bin/env bash
# Nothing multiplies and adds with one rounding: results would hang on the processor that a build is for. Compilers contract in spite of
# -ffp-contract=off here and there (see CMakeLists.txt).
set -euo pipefail
contracted=$(objdump -d -C --no-show-raw-insn "$1" | awk '/^[0-9a-f]+ <.*>:$/ { name = $0 } /\tvfn?m(add|sub)/ { print name }' | sort -u)
if [ -n "$contracted" ]; then
  echo "compiled with contracted products and sums:"
  echo "$contracted"
  exit 1
fi
