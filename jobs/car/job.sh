# The car's equilibrium: tyres seated and inflated, gravity and springs, the road rises, the car stands.
# Sourced by jobs/run.sh with the number of ranks and the folder of the results.
ranks=$1
output=$2

"$BALOCCO_BUILD/balocco" car "$balocco_root/jobs/car/car.toml" --output "$output/car.inp" | tee "$output/car.txt"
"$PYTHON" "$balocco_root/jobs/report/car_picture.py" "$output/car.inp" "$output/car.png"
"${BALOCCO_MPIRUN[@]}" -n "$ranks" "$BALOCCO_BUILD/balocco" run "$output/car.inp" --output "$output"
"$PYTHON" "$balocco_root/jobs/report/car_equilibrium.py" "$output/car.h5" | tee "$output/equilibrium.txt"
