# Laws of contact pressure and their change from step to step, with both kinds of masters.
verification_cases(contact_law 120 pressed standing released bouncing hard_blow friction_comes_in friction_comes_in_explicit friction_restarted behavior_changes tied)
