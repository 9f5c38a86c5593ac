# Springs, dashpots and point masses against closed forms, in both procedures, on one rank and on two.
verification_cases(spring 60 stable_increment beside_elements mass_on_spring bump_and_rebound static_springs dashpot_in_statics swinging_spring springs_in_a_body)
