#!/usr/bin/env bash
# kill -9 in mid-run leaves files that can be read and restarted; the restarted run equals the uninterrupted one.
source "$(dirname "$0")/small_tyre.sh"

cp -r "$folder/static" "$folder/whole"
run_on 1 "$folder/whole" --restart

# A job that had ended before it was killed has proved nothing: again.
killed=no
for attempt in 1 2 3 4 5; do
  start_rolling "$folder/killed"
  pkill -KILL -P "$job" || true  # the ranks, which mpirun started
  wait "$job" || { killed=yes; break; }
done
[ "$killed" = yes ] || { echo "the job ended each time before it was killed"; exit 1; }

"$balocco" info "$folder/killed/small_tyre.h5" >"$folder/info.out"
run_on 2 "$folder/killed" --restart
same_results "$folder/whole" "$folder/killed"
