# Beams and nodes that turn, in both procedures.
verification_cases(beam 60 import_at_rest vibration tumbling)
verification_cases(follower 60 bent_cantilever spinning_thruster)
