# Implicit dynamics against closed forms, on one rank and on two.
verification_cases(dynamic 60 rate_of_error procedures_in_turn free_flight spinning_body moderate_dissipation growing_increments lone_masses initial_no
                   stopped_and_resumed connectors impact)
verification_cases(modal 60 response forces material_damping fast)
verification_cases(steady_state 60 forced shaken turned coupled preloaded frequencies bar printed calculix weighed unbounded)
