# Static cases with known answers, each on one and on two ranks through the whole program.
verification_cases(static 120 patch_c3d8r patch_c3d8 elastica rollup rotation release linear hencky road touchdown unloading turning_back
                   far_reference ring flat_sheet mechanism contradiction)

foreach(case stabilized snap_through velocity gravity moment pinned petsc interrupted linear_interrupted kept_factors)
  add_test(NAME static_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/static_option_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/static_${case})
  set_tests_properties(static_${case} PROPERTIES LABELS verification TIMEOUT 120 PROCESSORS 2)
endforeach()
