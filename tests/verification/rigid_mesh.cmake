# Rigid meshes of R3D3 and R3D4 as contact masters, beside analytical surfaces of the same shape.
verification_cases(rigid_mesh 60 pressed_by_a_ball dropped_on_a_sheet rolling_off)
