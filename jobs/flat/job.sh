# The quick job on three tyres: the left front one loses its air as the drive begins, and meets the obstacle flat. Sourced by jobs/run.sh
# with the number of ranks and the folder of the results.
balocco_car_spec=$balocco_root/jobs/flat/car.toml BALOCCO_FIDELITY=rigid source "$balocco_root/jobs/car/job.sh" "$1" "$2"
