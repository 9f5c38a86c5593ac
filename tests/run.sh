#!/usr/bin/env bash
# Builds Balocco and passes its tests, on a bare Debian 12 machine too. Arguments go to ctest (e.g. -R verification).
set -euo pipefail

source "$(dirname "$0")/../jobs/setup.sh"
balocco_build -DBALOCCO_TESTS=ON
cd "$BALOCCO_BUILD" && ctest -j "${BALOCCO_JOBS:-2}" --output-on-failure --repeat after-timeout:2 "$@"
