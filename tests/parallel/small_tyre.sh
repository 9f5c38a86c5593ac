# A small tyre that has been seated, inflated and loaded, ready to roll: sourced by the tests of this folder.
# usage: source small_tyre.sh BINARY FOLDER     leaves FOLDER/static/ with the results and the checkpoint of the static steps
set -euo pipefail

balocco=$1
folder=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1

run_on() { # run_on RANKS OUTPUT [options...]
  mpirun --oversubscribe -n "$1" "$balocco" run "$folder/small_tyre.inp" --output "$2" "${@:3}" >"$2.out" 2>&1 ||
    { tail -n 20 "$2.out"; return 1; }
}

same_results() { # same_results A B: every frame and history of two jobs, bit for bit
  h5diff "$1/small_tyre.h5" "$2/small_tyre.h5" ||
    { echo "$1 and $2 differ"; return 1; }
}

# start_rolling FOLDER: a run of its own on two ranks, process $job, which is rolling on return (or, on a fast machine, through).
start_rolling() {
  rm -rf "$1"
  cp -r "$folder/static" "$1"
  mpirun --oversubscribe -n 2 "$balocco" run "$folder/small_tyre.inp" --output "$1" --restart >"$1.out" 2>&1 &
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
"$balocco" tyre "$here/small_tyre.toml" --output "$folder/small_tyre.inp" >"$folder/builder.out"
run_on 2 "$folder/static" --until LOAD
