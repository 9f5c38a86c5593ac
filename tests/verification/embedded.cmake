# Elements embedded in solids: the patch test, on one rank and on two.
add_test(NAME embedded_patch
         COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/embedded_cases.py patch $<TARGET_FILE:balocco> ${CMAKE_CURRENT_BINARY_DIR}/embedded_patch)
set_tests_properties(embedded_patch PROPERTIES LABELS verification TIMEOUT 60 PROCESSORS 2)
