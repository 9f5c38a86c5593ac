# Tractions on faces and on edges of sheets, in both procedures.
verification_cases(traction 60 bent_strip pulled_and_sheared as_pressure turned_block thrown_sheet)
