#!/usr/bin/env bash
# One, two and three ranks roll from the same imported state: their result files must not differ in a single bit.
source "$(dirname "$0")/small_tyre.sh"

for ranks in 1 2 3; do
  cp -r "$folder/static" "$folder/on_$ranks"
  run_on "$ranks" "$folder/on_$ranks" --restart
done
same_results "$folder/on_1" "$folder/on_2"
same_results "$folder/on_1" "$folder/on_3"
