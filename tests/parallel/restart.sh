#!/usr/bin/env bash
# A run stopped half-way through rolling and restarted on another number of ranks equals the uninterrupted run.
source "$(dirname "$0")/small_tyre.sh"

cp -r "$folder/static" "$folder/whole"
cp -r "$folder/static" "$folder/stopped"
run_on 1 "$folder/whole" --restart

# The job asks itself to stop through its control file, as a user would.
mpirun --oversubscribe -n 2 "$balocco" run "$folder/small_tyre.inp" --output "$folder/stopped" --restart >"$folder/stopped.out" 2>&1 &
job=$!
until grep -q "ROLL" "$folder/stopped/small_tyre.sta"; do kill -0 "$job"; sleep 0.05; done
echo stop >"$folder/stopped/small_tyre.ctl"
status=0
wait "$job" || status=$?
[ "$status" -eq 4 ] || { echo "a stopped job must leave with 4, not $status"; tail "$folder/stopped.out"; exit 1; }

run_on 3 "$folder/stopped" --restart
same_results "$folder/whole" "$folder/stopped"
