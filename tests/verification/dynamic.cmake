# Implicit dynamics against closed forms, on one rank and on two.
foreach(case rate_of_error procedures_in_turn free_flight spinning_body modal_response stopped_and_resumed)
  add_test(NAME dynamic_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/dynamic_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/dynamic_${case})
  set_tests_properties(dynamic_${case} PROPERTIES LABELS verification TIMEOUT 60 PROCESSORS 2)
endforeach()
