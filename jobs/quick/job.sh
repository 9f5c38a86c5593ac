# The main job made small: coarse tyres, a rigid body, 150 ms, in which the front wheels cross the comfort obstacle. What it changes in
# the specs of jobs/car stands in car.sed and tyre.sed. Sourced by jobs/run.sh with the number of ranks and the folder of the results.
ranks=$1
results=$2
here=$balocco_root/jobs/quick
sed -f "$here/tyre.sed" "$balocco_root/jobs/car/tyre.toml" >"$results/tyre.toml"
sed -f "$here/car.sed" "$balocco_root/jobs/car/car.toml" >"$results/car.toml"
balocco_car_spec=$results/car.toml BALOCCO_FIDELITY=rigid source "$balocco_root/jobs/car/job.sh" "$ranks" "$results"
