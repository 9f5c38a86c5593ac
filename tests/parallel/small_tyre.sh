#!/usr/bin/env bash
# A small tyre for the tests of this folder: FOLDER/static, where it has been seated, inflated and loaded and is ready to roll, and
# FOLDER/whole, where it has rolled on one rank.
# usage: small_tyre.sh BINARY FOLDER
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/rolling.sh" "$1" "$2" "$2"

"$balocco" tyre "$here/small_tyre.toml" --output "$tyre/small_tyre.inp" >"$tyre/builder.out"
run_on 2 "$tyre/static" --until LOAD
roll_on 1 "$tyre/whole"
