# Static perturbations, on one rank and on two.
verification_cases(perturbation 120 taut_string bent_state first_step)
