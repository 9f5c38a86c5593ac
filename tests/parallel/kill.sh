#!/usr/bin/env bash
# kill -9 in mid-run leaves files that can be read and restarted; the restarted run equals the uninterrupted one.
source "$(dirname "$0")/small_tyre.sh"

cp -r "$folder/static" "$folder/whole"
cp -r "$folder/static" "$folder/killed"
run_on 1 "$folder/whole" --restart

mpirun --oversubscribe -n 2 "$balocco" run "$folder/small_tyre.inp" --output "$folder/killed" --restart >"$folder/killed.out" 2>&1 &
job=$!
until grep -q "ROLL" "$folder/killed/small_tyre.sta"; do kill -0 "$job"; sleep 0.05; done
pkill -KILL -P "$job"  # the ranks, which mpirun started
if wait "$job"; then echo "the job ended before it was killed"; exit 1; fi

"$balocco" info "$folder/killed/small_tyre.h5" >"$folder/info.out"
run_on 2 "$folder/killed" --restart
same_results "$folder/whole" "$folder/killed"
