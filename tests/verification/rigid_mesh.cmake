# Rigid meshes of R3D3 and R3D4 as contact masters, beside analytical surfaces of the same shape.
foreach(case pressed_by_a_ball dropped_on_a_sheet rolling_off)
  add_test(NAME rigid_mesh_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/rigid_mesh_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/rigid_mesh_${case})
  set_tests_properties(rigid_mesh_${case} PROPERTIES LABELS verification TIMEOUT 60 PROCESSORS 2)
endforeach()
