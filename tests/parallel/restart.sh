#!/usr/bin/env bash
# A run stopped half-way through rolling and restarted on another number of ranks equals the uninterrupted run.
source "$(dirname "$0")/rolling.sh"

ask_to_stop() { echo stop >"$folder/stopped/small_tyre.ctl"; }  # as a user would
interrupt_rolling "$folder/stopped" ask_to_stop
[ "$status" -eq 4 ] || { echo "a stopped job must leave with 4, not $status"; tail "$folder/stopped.out"; exit 1; }

run_on 3 "$folder/stopped" --restart
same_results "$folder/stopped"
