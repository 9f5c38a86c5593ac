# Forces on all matter of a set against closed forms, on one rank and on two.
verification_cases(body_load 60 volume_force spinning_rod spun_mass)
