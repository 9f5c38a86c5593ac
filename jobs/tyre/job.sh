# The main job: a 165/65R14 tyre is mounted, inflated, loaded and rolls over the 100 x 25 mm obstacle at 40 km/h.
# Sourced by jobs/run.sh with the number of ranks and the folder of the results.
ranks=$1
output=$2

"$BALOCCO_BUILD/balocco" tyre "$balocco_root/jobs/tyre/tyre.toml" --output "$output/tyre.inp" --picture "$output/section.svg" |
  tee "$output/tyre.txt"
"${BALOCCO_MPIRUN[@]}" -n "$ranks" "$BALOCCO_BUILD/balocco" run "$output/tyre.inp" --output "$output"
"$PYTHON" "$balocco_root/jobs/report/report.py" "$output/tyre.h5" --output "$output/report"
