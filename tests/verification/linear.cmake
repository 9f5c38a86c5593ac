# Geometrically linear steps, on one and on two ranks through the whole program.
verification_cases(linear 120 superposition small_strain then_finite equations_removed released mean_rotation dummy_nodes)
