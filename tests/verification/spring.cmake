# Springs, dashpots and point masses against closed forms, in both procedures, on one rank and on two.
foreach(case stable_increment mass_on_spring bump_and_rebound static_springs dashpot_in_statics swinging_spring)
  add_test(NAME spring_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/spring_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/spring_${case})
  set_tests_properties(spring_${case} PROPERTIES LABELS verification TIMEOUT 60 PROCESSORS 2)
endforeach()
