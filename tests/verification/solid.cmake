# Tetrahedra, quadratic and incompatible solids: closed forms through the whole program.
foreach(case pressed bending spinning le10 modes falling)
  add_test(NAME solid_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/solid_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/solid_${case})
  set_tests_properties(solid_${case} PROPERTIES LABELS verification TIMEOUT 240 PROCESSORS 2)
endforeach()
