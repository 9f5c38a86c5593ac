# Tetrahedra, quadratic and incompatible solids: closed forms through the whole program.
verification_cases(solid 240 pressed bending spinning le10 modes falling)
verification_cases(orientation 240 directions_of_elements thickness_of_elements coupling_in_cylindrical_axes section_turns_with_its_part)
