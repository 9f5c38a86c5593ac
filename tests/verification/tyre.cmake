# The coarse tyre through all its steps, on one rank or on two: parallel_bitwise shows that both give the same bits.
foreach(place at_rest_on_2 rolling_on_2 rolling_on_membranes_on_2 rolling_start_on_1)
  string(REGEX MATCH "^(.*)_on_([0-9])$" name ${place})
  set(case ${CMAKE_MATCH_1})
  set(ranks ${CMAKE_MATCH_2})
  add_test(NAME tyre_${name}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/tyre_cases.py ${case} $<TARGET_FILE:balocco> ${ranks}
                   ${CMAKE_CURRENT_BINARY_DIR}/tyre_${name})
  set_tests_properties(tyre_${name} PROPERTIES LABELS verification TIMEOUT 180 PROCESSORS ${ranks})
endforeach()
