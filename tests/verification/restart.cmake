# *RESTART, READ: more and longer steps behind the checkpoint of another job, with the bits of one deck.
foreach(case more_steps longer_step ended_step refusals)
  add_test(NAME restart_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/restart_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/restart_${case})
  set_tests_properties(restart_${case} PROPERTIES LABELS verification TIMEOUT 120 PROCESSORS 2)
endforeach()
