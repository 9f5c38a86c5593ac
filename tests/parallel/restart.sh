#!/usr/bin/env bash
# A run stopped half-way through rolling and restarted on another number of ranks equals the uninterrupted run.
source "$(dirname "$0")/small_tyre.sh"

cp -r "$folder/static" "$folder/whole"
run_on 1 "$folder/whole" --restart

# The job is asked to stop through its control file, as a user would. One that had ended by then has proved nothing: again.
status=0
for attempt in 1 2 3 4 5; do
  start_rolling "$folder/stopped"
  echo stop >"$folder/stopped/small_tyre.ctl"
  status=0
  wait "$job" || status=$?
  [ "$status" -eq 0 ] || break
done
[ "$status" -eq 4 ] || { echo "a stopped job must leave with 4, not $status"; tail "$folder/stopped.out"; exit 1; }

run_on 3 "$folder/stopped" --restart
same_results "$folder/whole" "$folder/stopped"
