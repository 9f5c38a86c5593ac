# The car's equilibrium: tyres seated and inflated, gravity and springs, the road rises, the car stands. With BALOCCO_OBSTACLE=comfort or
# BALOCCO_OBSTACLE=pothole it drives on from there, over the comfort obstacle or with its left wheels through the pothole.
# Its report is report.html there. Sourced by jobs/run.sh with the number of ranks and the folder of the results.
ranks=$1
obstacle=${BALOCCO_OBSTACLE:-comfort}
output=$2/$obstacle
mkdir -p "$output"
rm -f "$output/kinematics.h5" "$output/drive.h5"    # the report tells of this job alone

"$BALOCCO_BUILD/balocco" car "$balocco_root/jobs/car/car.toml" --obstacle "$obstacle" --output "$output/car.inp" \
  --drive "$output/drive.inp" --kinematics "$output/kinematics.inp" | tee "$output/car.txt"
"$PYTHON" "$balocco_root/jobs/report/car_picture.py" "$output/car.inp" "$output/car.png"
"${BALOCCO_MPIRUN[@]}" -n 1 "$BALOCCO_BUILD/balocco" run "$output/kinematics.inp" --output "$output"
"$PYTHON" "$balocco_root/jobs/report/car_kinematics.py" "$output/kinematics.h5" | tee "$output/kinematics.txt"
"${BALOCCO_MPIRUN[@]}" -n "$ranks" "$BALOCCO_BUILD/balocco" run "$output/car.inp" --output "$output"
"$PYTHON" "$balocco_root/jobs/report/car_equilibrium.py" "$output/car.h5" | tee "$output/equilibrium.txt"
if [ -n "${BALOCCO_OBSTACLE:-}" ]; then
  "${BALOCCO_MPIRUN[@]}" -n "$ranks" "$BALOCCO_BUILD/balocco" run "$output/drive.inp" --import "$output/car.ckpt.h5" --output "$output"
  "$PYTHON" "$balocco_root/jobs/report/car_loads.py" "$output/drive.inp" "$output/drive.h5" "$output/loads.csv" | tee "$output/loads.txt"
fi
"$PYTHON" "$balocco_root/jobs/report/car_report.py" "$output" "$output/report.html"
