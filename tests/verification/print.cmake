# The tables of JOB.dat.
foreach(case tables section restart)
  add_test(NAME print_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/print_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/print_${case})
  set_tests_properties(print_${case} PROPERTIES LABELS verification TIMEOUT 120 PROCESSORS 2)
endforeach()
