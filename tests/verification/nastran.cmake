# A published wheel in Nastran bulk data, where a copy lies beside the source tree; skipped elsewhere.
foreach(case wheel_mass wheel_frequency wheel_of_car)
  add_test(NAME nastran_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/nastran_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/nastran_${case} ${CMAKE_SOURCE_DIR}/../shared/data/wheel_steel/hub_static.bdf)
  set_tests_properties(nastran_${case} PROPERTIES LABELS verification TIMEOUT 120 SKIP_RETURN_CODE 77)
endforeach()
