#!/usr/bin/env bash
# Runs a named job on two ranks and writes its report.
# usage: bash jobs/run.sh [NAME] [ranks]      NAME: a folder of jobs/ with a job.sh (default: car, the main job)
set -euo pipefail

name=${1:-car}
ranks=${2:-2}
folder=$(cd "$(dirname "$0")" && pwd)
if [ ! -f "$folder/$name/job.sh" ]; then
  echo "jobs/run.sh: no job '$name'; there are: $(cd "$folder" && for job in */job.sh; do printf '%s ' "${job%/job.sh}"; done)" >&2
  exit 2
fi

source "$folder/setup.sh"
balocco_build -DBALOCCO_TESTS=OFF
mkdir -p "$balocco_root/results/$name"
source "$folder/$name/job.sh" "$ranks" "$balocco_root/results/$name"
