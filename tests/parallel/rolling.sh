# What the tests on the small tyre have in common: sourced by them.
# usage: source rolling.sh BINARY TYRE FOLDER     makes FOLDER anew; TYRE is what small_tyre.sh has left
set -euo pipefail

balocco=$1
tyre=$2
folder=$3
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1

run_on() { # run_on RANKS OUTPUT [options...]
  mpirun --oversubscribe -n "$1" "$balocco" run "$tyre/small_tyre.inp" --output "$2" "${@:3}" >"$2.out" 2>&1 ||
    { tail -n 20 "$2.out"; return 1; }
}

roll_on() { # roll_on RANKS OUTPUT: from the static steps
  cp -r "$tyre/static" "$2"
  run_on "$1" "$2" --restart
}

same_results() { # same_results FOLDER: every frame and history as the whole run has them, bit for bit
  h5diff "$tyre/whole/small_tyre.h5" "$1/small_tyre.h5" ||
    { echo "$tyre/whole and $1 differ"; return 1; }
}

# start_rolling FOLDER: a run of its own on two ranks, process $job, which is rolling on return (or, on a fast machine, through).
start_rolling() {
  rm -rf "$1"
  cp -r "$tyre/static" "$1"
  mpirun --oversubscribe -n 2 "$balocco" run "$tyre/small_tyre.inp" --output "$1" --restart >"$1.out" 2>&1 &
  job=$!
  until grep -q "ROLL" "$1/small_tyre.sta"; do kill -0 "$job"; sleep 0.02; done
}

# interrupt_rolling FOLDER COMMAND...: COMMAND ends such a run, whose exit status is left in $status. A job that had ended by then
# has proved nothing: again.
interrupt_rolling() {
  for attempt in 1 2 3 4 5; do
    start_rolling "$1"
    "${@:2}"
    status=0
    wait "$job" || status=$?
    [ "$status" -eq 0 ] || return 0
  done
  echo "the job ended each time before it was interrupted"
  return 1
}

rm -rf "$folder"
mkdir -p "$folder"
