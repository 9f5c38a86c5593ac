# What elements bring along and when they take part: initial stress and hardening, *MODEL CHANGE, springs of rotations.
foreach(case initial_stress initial_hardening taken_out torsion plastic_bending rates_in_statics)
  add_test(NAME element_state_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/element_state_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/element_state_${case})
  set_tests_properties(element_state_${case} PROPERTIES LABELS verification TIMEOUT 60 PROCESSORS 2)
endforeach()
