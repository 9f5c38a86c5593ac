# Explicit dynamics: small decks with closed-form answers, on one and on two ranks.
foreach(case truss_stability rod_impact free_flight spun_block pendulum dzhanibekov dzhanibekov_node skid sliding_block chattering_block resting_pair resting_block driven_block)
  foreach(ranks 1 2)
    add_test(NAME explicit_${case}_on_${ranks}
             COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/explicit_cases.py ${case} $<TARGET_FILE:balocco> ${ranks}
                     ${CMAKE_CURRENT_BINARY_DIR}/explicit_${case}_on_${ranks})
    set_tests_properties(explicit_${case}_on_${ranks} PROPERTIES LABELS verification TIMEOUT 180 PROCESSORS ${ranks})
  endforeach()
endforeach()
foreach(case bouncing_plate hard_hits hit_at_the_end pressed_block rubbing_block lifted_block velocities_set_once lost_energy blown_up_at_the_end crushed_block past_the_end below_the_ground rigid_part)
  foreach(ranks 1 2)
    add_test(NAME explicit_${case}_on_${ranks}
             COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/explicit_contact_cases.py ${case} $<TARGET_FILE:balocco> ${ranks}
                     ${CMAKE_CURRENT_BINARY_DIR}/explicit_${case}_on_${ranks})
    set_tests_properties(explicit_${case}_on_${ranks} PROPERTIES LABELS verification TIMEOUT 180 PROCESSORS ${ranks})
  endforeach()
endforeach()
