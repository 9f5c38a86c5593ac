#!/bin/bash
# usage: run_case.sh BINARY RANKS DECK...
# Each deck is bad. Its first line says "** expect: MESSAGE" (a fragment). The run must end with status 2 within 20 s, print the
# message exactly once on stderr, print one error in all, and leave no file behind.
set -u

check() {
  local binary=$1 ranks=$2 deck=$3 folder status expected troubles="" launcher=()
  folder=$(mktemp -d)
  mkdir "$folder/results" "$folder/mpi"
  expected=$(head -n 1 "$deck" | sed 's/^\*\* expect: //')
  [ "$ranks" -eq 1 ] || launcher=(mpirun --allow-run-as-root --oversubscribe -n "$ranks")
  # A rank by itself needs no daemon, but a folder for Open MPI's files of its own: decks run side by side.
  OMPI_MCA_orte_tmpdir_base="$folder/mpi" OMPI_MCA_ess_singleton_isolated=1 timeout 20 "${launcher[@]}" "$binary" run "$deck" --output "$folder/results" \
    >"$folder/out" 2>"$folder/err"
  status=$?
  [ $status -eq 2 ] || troubles+="exit status $status instead of 2; "
  [ "$(grep -cF -- "$expected" "$folder/err")" -eq 1 ] || troubles+="'$expected' not told exactly once; "
  [ "$(grep -c 'error: ' "$folder/err")" -eq 1 ] || troubles+="not just one error; "
  [ -z "$(ls -A "$folder/results")" ] || troubles+="left $(ls -A "$folder/results" | tr '\n' ' ')behind; "
  if [ -n "$troubles" ]; then
    echo "FAILED $(basename "$deck") on $ranks ranks: $troubles"
    sed 's/^/    /' "$folder/err" | head -n 25
  fi
  rm -rf "$folder"
  [ -z "$troubles" ]
}

if [ "$1" = --one ]; then
  check "$2" "$3" "$4"
  exit
fi
binary=$1
ranks=$2
shift 2
# mpirun mostly waits: several at a time take no longer than one.
printf '%s\0' "$@" | xargs -0 -n 1 -P 8 "$0" --one "$binary" "$ranks" && echo "$# bad decks refused as they should be"
