# Mass scaling of explicit steps: added masses, increments and frequencies in closed form, and the same bits as denser matter.
foreach(case tiny_element kinds vibration heavier_matter weight keeps_its_increment steps_and_ranks with_linkages)
  add_test(NAME mass_scaling_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/mass_scaling_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/mass_scaling_${case})
  set_tests_properties(mass_scaling_${case} PROPERTIES LABELS verification TIMEOUT 180 PROCESSORS 2)
endforeach()
