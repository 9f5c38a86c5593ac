# Beams and nodes that turn, in both procedures.
verification_cases(beam 60 import_at_rest vibration tumbling)
