# The built car.
foreach(case beam_twist kinematics body_torsion drop equilibrium)
  add_test(NAME car_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/car_cases.py ${case} $<TARGET_FILE:balocco> 2 ${CMAKE_CURRENT_BINARY_DIR}/car_${case})
  set_tests_properties(car_${case} PROPERTIES LABELS verification TIMEOUT 240 PROCESSORS 2)
endforeach()
