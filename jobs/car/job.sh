# The main job: the semi-flexible car stands on its tyres, then drives over the comfort obstacle. BALOCCO_OBSTACLE=pothole: with its left
# wheels through the pothole; =drop: it falls on its wheels instead, from 0.5 m; BALOCCO_FIDELITY=rigid or complete: with less or all of
# it deforming. Its report is report.html there.
# Sourced by jobs/run.sh with the number of ranks and the folder of the results.
ranks=$1
obstacle=${BALOCCO_OBSTACLE:-comfort}
fidelity=${BALOCCO_FIDELITY:-semi-flexible}
spec=${balocco_car_spec:-$balocco_root/jobs/car/car.toml}
output=$2/${obstacle}_$fidelity
mkdir -p "$output"
rm -f "$output/kinematics.h5" "$output/drive.h5"    # the report tells of this job alone

"$BALOCCO_BUILD/balocco" car "$spec" --fidelity rigid --output "$output/car.inp" \
  --kinematics "$output/kinematics.inp" >/dev/null    # the axles' own kinematics: nothing else gives way
"${BALOCCO_MPIRUN[@]}" -n 1 "$BALOCCO_BUILD/balocco" run "$output/kinematics.inp" --output "$output"
"$BALOCCO_BUILD/balocco" car "$spec" --obstacle "$obstacle" --fidelity "$fidelity" --output "$output/car.inp" \
  --drive "$output/drive.inp" --tyre "$output/tyre.inp" | tee "$output/car.txt"
"$PYTHON" "$balocco_root/jobs/report/car_picture.py" "$output/car.inp" "$output/car.png"
"$PYTHON" "$balocco_root/jobs/report/car_kinematics.py" "$output/kinematics.h5" | tee "$output/kinematics.txt"
"${BALOCCO_MPIRUN[@]}" -n "$ranks" "$BALOCCO_BUILD/balocco" run "$output/tyre.inp" --output "$output"    # one tyre is inflated for all four
"${BALOCCO_MPIRUN[@]}" -n "$ranks" "$BALOCCO_BUILD/balocco" run "$output/car.inp" --import "$output/tyre.ckpt.h5" --output "$output"
"$PYTHON" "$balocco_root/jobs/report/car_equilibrium.py" "$output/car.h5" | tee "$output/equilibrium.txt"
"${BALOCCO_MPIRUN[@]}" -n "$ranks" "$BALOCCO_BUILD/balocco" run "$output/drive.inp" --import "$output/car.ckpt.h5" --output "$output"
"$PYTHON" "$balocco_root/jobs/report/car_loads.py" "$output/drive.inp" "$output/drive.h5" "$output/loads.csv" | tee "$output/loads.txt"
"$PYTHON" "$balocco_root/jobs/report/car_report.py" "$output" "$output/report.html"
