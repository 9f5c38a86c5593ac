# Constraints, joints and couplings against closed forms and fine integrations, in both procedures, on one rank and on more.
verification_cases(joint 120 masses_on_links falling_chain four_bar universal_joint turned_fast)
verification_cases(constraint 120 coupled_tip turned_coupling equations tied_blocks
                   welded_sheets rest_with_constraints hanging_at_rest same_bits springs_on_an_arm)
verification_cases(connector 120 strut damped_strut struck_pendulum braked_rotor rubbing_slider slider_crank on_the_ground driven_hinge thrown_off joints_of_constraints)
verification_cases(rigid_part 120 carousel thrown_plate carried_inertia plates_made_rigid)
verification_cases(import 120 driving_from_an_equilibrium importing_parts importing_the_mesh updating_the_reference updating_bodies importing_copies bodies_keep_their_nodes)
verification_cases(linkage 120 heavy_top blown_flaps thrown_crank loaded_crank joined_instances)
verification_cases(multi_point 120 revolute_angle universal_angles rigid_chains)
verification_cases(shared_coupling 120 with_each_other with_ties with_bodies by_nodes opened_cloud)
verification_cases(weld 120 closed_section tied_sheets tumbling_star sheets_thrown reach)
verification_cases(weld 240 stacked_sheets)
