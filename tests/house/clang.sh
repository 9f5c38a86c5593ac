#!/usr/bin/env bash
# Clang, which knows less of the C++20 library than GCC, understands what is compiled in batches. A folder is one batch here: no two of its
# files may give their own things the same name.
# usage: clang.sh CLANG ROOT [compiler arguments...]
set -euo pipefail
clang=$1
cd "$2"
[ -x "$clang" ] || { echo "there is no Clang on this machine"; exit 77; }

for folder in solvers io; do
  find "$folder" -name '*.cpp' | sort | sed 's|.*|#include "&"|' | "$clang" -std=c++20 -fsyntax-only -w -I. "${@:3}" -x c++ -
done
