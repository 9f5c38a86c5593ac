# Geometrically linear steps, on one and on two ranks through the whole program.
foreach(case superposition small_strain then_finite)
  add_test(NAME linear_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/linear_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/linear_${case})
  set_tests_properties(linear_${case} PROPERTIES LABELS verification TIMEOUT 120 PROCESSORS 2)
endforeach()
