# Explicit dynamics: small decks with closed-form answers, on one and on two ranks.
function(explicit_case script case)
  foreach(ranks ${ARGN})
    add_test(NAME explicit_${case}_on_${ranks}
             COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/${script}.py ${case} $<TARGET_FILE:balocco> ${ranks}
                     ${CMAKE_CURRENT_BINARY_DIR}/explicit_${case}_on_${ranks})
    set_tests_properties(explicit_${case}_on_${ranks} PROPERTIES LABELS verification TIMEOUT 180 PROCESSORS ${ranks})
  endforeach()
endfunction()

foreach(case truss_stability rod_impact free_flight spun_block pendulum dzhanibekov dzhanibekov_node skid sliding_block chattering_block resting_pair resting_block driven_block
             first_increment)
  explicit_case(explicit_cases ${case} 1 2)
endforeach()
foreach(case bouncing_plate touching_at_the_start pressed_block rubbing_block limits_of_friction lifted_block velocities_set_once lost_energy blown_up_at_the_end past_the_end below_the_ground rigid_part)
  explicit_case(explicit_contact_cases ${case} 1 2)
endforeach()
foreach(case hard_hits hit_at_the_end crushed_block folded_corner)
  explicit_case(explicit_contact_cases ${case} 1)  # the longer ones: the bits do not depend on the ranks
endforeach()
