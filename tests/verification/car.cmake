# The built car.
add_test(NAME car_body_torsion
         COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/car_cases.py body_torsion $<TARGET_FILE:balocco> 2 ${CMAKE_CURRENT_BINARY_DIR}/car_body_torsion)
set_tests_properties(car_body_torsion PROPERTIES LABELS verification TIMEOUT 180 PROCESSORS 2)
