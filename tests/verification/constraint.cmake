# Constraints, joints and couplings against closed forms and fine integrations, in both procedures, on one rank and on more.
foreach(case masses_on_links falling_chain carousel thrown_plate four_bar universal_joint coupled_tip turned_coupling equations tied_blocks welded_sheets rest_with_constraints same_bits springs_on_an_arm plates_made_rigid)
  add_test(NAME constraint_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/constraint_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/constraint_${case})
  set_tests_properties(constraint_${case} PROPERTIES LABELS verification TIMEOUT 120 PROCESSORS 2)
endforeach()
foreach(case strut struck_pendulum braked_rotor rubbing_slider slider_crank on_the_ground driven_hinge)
  add_test(NAME connector_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/connector_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/connector_${case})
  set_tests_properties(connector_${case} PROPERTIES LABELS verification TIMEOUT 120 PROCESSORS 2)
endforeach()
foreach(case driving_from_an_equilibrium importing_parts importing_the_mesh bodies_keep_their_nodes)
  add_test(NAME import_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/import_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/import_${case})
  set_tests_properties(import_${case} PROPERTIES LABELS verification TIMEOUT 120 PROCESSORS 2)
endforeach()
