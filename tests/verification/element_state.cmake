# What elements bring along and when they take part: initial stress and hardening, *MODEL CHANGE, springs of rotations.
verification_cases(element_state 60 initial_stress linear_initial_stress initial_hardening taken_out torsion plastic_bending plastic_cantilever rates_in_statics)
verification_cases(initial_stress 60 steel heated beams)
verification_cases(sheet_state 60 held_and_let_go yielding buckled)
