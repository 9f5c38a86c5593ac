# The coarse tyre through all its steps, on one and on two ranks.
foreach(case at_rest rolling rolling_on_membranes rolling_start)
  foreach(ranks 1 2)
    add_test(NAME tyre_${case}_on_${ranks}
             COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/tyre_cases.py ${case} $<TARGET_FILE:balocco> ${ranks}
                     ${CMAKE_CURRENT_BINARY_DIR}/tyre_${case}_on_${ranks})
    set_tests_properties(tyre_${case}_on_${ranks} PROPERTIES LABELS verification TIMEOUT 180 PROCESSORS ${ranks})
  endforeach()
endforeach()
