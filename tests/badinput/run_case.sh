#!/bin/bash
# usage: run_case.sh BINARY RANKS DECK...
# Each deck is bad. Its first line says "** expect: MESSAGE" (a fragment). The run must end with status 2 within 20 s, print the
# message exactly once on stderr, print one error in all, and leave no file behind.
set -u
binary=$1
ranks=$2
shift 2
failures=0

tell() {
  echo "FAILED $name ($ranks ranks): $1"
  failures=$((failures + 1))
}

for deck in "$@"; do
  name=$(basename "$deck" .inp)
  expected=$(head -n 1 "$deck" | sed 's/^\*\* expect: //')
  folder=$(mktemp -d)
  timeout 20 mpirun --allow-run-as-root --oversubscribe -n "$ranks" "$binary" run "$deck" --output "$folder" \
    >"$folder.out" 2>"$folder.err"
  status=$?
  [ $status -eq 2 ] || tell "exit status $status instead of 2"
  [ "$(grep -cF -- "$expected" "$folder.err")" -eq 1 ] || tell "'$expected' not told exactly once"
  [ "$(grep -c ': error: ' "$folder.err")" -eq 1 ] || tell "more or less than one error"
  [ -z "$(ls -A "$folder")" ] || tell "left $(ls -A "$folder" | tr '\n' ' ')behind"
  [ $failures -eq 0 ] || sed 's/^/    /' "$folder.err" | head -n 25
  rm -rf "$folder" "$folder.out" "$folder.err"
done
[ $failures -eq 0 ] && echo "$# bad decks refused as they should be"
exit $((failures > 0))
