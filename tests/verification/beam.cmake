# Beams and nodes that turn, in both procedures.
foreach(case import_at_rest vibration tumbling)
  add_test(NAME beam_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/beam_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/beam_${case})
  set_tests_properties(beam_${case} PROPERTIES LABELS verification TIMEOUT 60 PROCESSORS 2)
endforeach()
