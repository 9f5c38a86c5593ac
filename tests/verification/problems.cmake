# The quick subset of the table that results.sh writes: coarse meshes, one rank.
foreach(name MH- HERTZ-CYL ELASTICA LE1 COOK SCOR PLATE UNIAX HENCKY BALLOON CLT RODS PEND DZHAN SLIDE DT- TAYLOR H5)
  add_test(NAME problem_${name}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/problems/table.py $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/problem_${name} --quick --only ${name})
  set_tests_properties(problem_${name} PROPERTIES LABELS verification TIMEOUT 120)
endforeach()
