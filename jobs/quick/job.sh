# The main job made small: coarse tyres, a rigid body, 150 ms, in which the front wheels cross the comfort obstacle. What it changes in
# the descriptions of jobs/car stands in car.toml and tyre.toml. Sourced by jobs/run.sh with the number of ranks and the folder of the
# results.
balocco_car_spec=$balocco_root/jobs/quick/car.toml BALOCCO_FIDELITY=rigid source "$balocco_root/jobs/car/job.sh" "$1" "$2"
