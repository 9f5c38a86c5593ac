# Contact with deformable masters.
verification_cases(mesh_contact 120 patch printed free_body sliding restarted standing_together rods explicit_rods at_rest skid released pushed_far)
