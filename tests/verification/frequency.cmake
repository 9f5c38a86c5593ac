# Natural modes against closed forms, on one and on two ranks through the whole program.
foreach(case free_bar string pendulum upside_down bounds free_cube strip_stretched strip_bent strip_buckled euler_column shaft sliding cantilever)
  add_test(NAME frequency_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/frequency_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/frequency_${case})
  set_tests_properties(frequency_${case} PROPERTIES LABELS verification TIMEOUT 120 PROCESSORS 2)
endforeach()
