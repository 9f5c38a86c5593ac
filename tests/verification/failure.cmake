# *SHEAR FAILURE: elements that fail are deleted.
foreach(case pulled ranks)
  add_test(NAME failure_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/failure_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/failure_${case})
  set_tests_properties(failure_${case} PROPERTIES LABELS verification TIMEOUT 120 PROCESSORS 2)
endforeach()
