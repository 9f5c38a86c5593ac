#!/usr/bin/env bash
# kill -9 in mid-run leaves files that can be read and restarted; the restarted run equals the uninterrupted one.
source "$(dirname "$0")/rolling.sh"

kill_ranks() { pkill -KILL -P "$job" || true; }  # mpirun started them
interrupt_rolling "$folder/killed" kill_ranks

"$balocco" info "$folder/killed/small_tyre.h5" >"$folder/info.out"
run_on 2 "$folder/killed" --restart
same_results "$folder/killed"
