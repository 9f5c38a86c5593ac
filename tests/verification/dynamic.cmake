# Implicit dynamics against closed forms, on one rank and on two.
verification_cases(dynamic 60 rate_of_error procedures_in_turn free_flight spinning_body modal_response modal_forces modal_material_damping modal_fast moderate_dissipation growing_increments lone_masses
                   stopped_and_resumed connectors impact)
