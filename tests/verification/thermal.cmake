# Thermal strains against closed forms: statics on one and on two ranks, the explicit loop bit for bit on one, two
# and three.
verification_cases(thermal 300 free oriented perturbed imported clamped table constants membrane shells_and_beams explicit refused)
