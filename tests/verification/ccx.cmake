# The same decks as CalculiX 2.20: its printed results stand beside them in ccx/, so that it need not be installed.
foreach(case elastic rubber loads sheets bars tripod faces)
  add_test(NAME ccx_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/ccx_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/ccx_${case})
  set_tests_properties(ccx_${case} PROPERTIES LABELS verification TIMEOUT 120 PROCESSORS 2)
endforeach()
# Decks of CalculiX's own suite, where a copy lies beside the source tree; skipped elsewhere.
foreach(case truss beamnldye)
  add_test(NAME ccx_suite_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/ccx_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/ccx_suite_${case} ${CMAKE_SOURCE_DIR}/../shared)
  set_tests_properties(ccx_suite_${case} PROPERTIES LABELS verification TIMEOUT 120 SKIP_RETURN_CODE 77)
endforeach()
