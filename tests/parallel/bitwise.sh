#!/usr/bin/env bash
# One, two and three ranks roll from the same imported state: their result files must not differ in a single bit.
source "$(dirname "$0")/rolling.sh"

for ranks in 2 3; do
  roll_on "$ranks" "$folder/on_$ranks"
  same_results "$folder/on_$ranks"
done
