# The same decks as CalculiX 2.20: its printed results stand beside them in ccx/, so that it need not be installed.
verification_cases(ccx 120 elastic rubber loads sheets bars tripod faces)
# Decks whose every printed table is that of CalculiX, on one rank and on two.
verification_cases(ccx_print 120 held_loads sudden_loads dummy_node removed_elements equation_totals heated)
# Decks of CalculiX's own suite, where a copy lies beside the source tree; skipped elsewhere. CCX.md tells of all of them.
foreach(case truss fricloop beamnldye beamnldype)
  add_test(NAME ccx_suite_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/ccx_cases.py ${case} $<TARGET_FILE:balocco>
                   ${CMAKE_CURRENT_BINARY_DIR}/ccx_suite_${case} ${CMAKE_SOURCE_DIR}/../shared)
  set_tests_properties(ccx_suite_${case} PROPERTIES LABELS verification TIMEOUT 120 SKIP_RETURN_CODE 77)
endforeach()
foreach(deck achteld achtelg beam10p beam20p beam8f beamd3 beamdelay beamhf beamnld beamnlp beampo1 beampo3 beampo6 beamprot beamwrite
        beamnldyp beamdynamic2 dashpot5 dashpot1 beam8b coupling10 mass1 spring2 spring7 beam8p_mpc beamptied1 beamptied2 beamrb2 coupling2 spring3 beamnlmpc
        beamp2rotate beamprb dyncube dyncubeexp cubes friction1 friction3 resstress1 spring5 changesurfbeh)
  add_test(NAME ccx_suite_${deck}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/ccx_table.py $<TARGET_FILE:balocco> ${CMAKE_SOURCE_DIR}/../shared
                   ${CMAKE_CURRENT_BINARY_DIR}/ccx_suite_${deck} --check ${deck})
  set_tests_properties(ccx_suite_${deck} PROPERTIES LABELS verification TIMEOUT 120 SKIP_RETURN_CODE 77)
endforeach()
