# Forces on all matter of a set against closed forms, on one rank and on two.
foreach(case volume_force spinning_rod spun_mass)
  add_test(NAME body_load_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/body_load_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/body_load_${case})
  set_tests_properties(body_load_${case} PROPERTIES LABELS verification TIMEOUT 60 PROCESSORS 2)
endforeach()
