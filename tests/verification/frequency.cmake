# Natural modes against closed forms, on one and on two ranks through the whole program.
verification_cases(frequency 120 free_bar string pendulum upside_down bounds free_cube strip_stretched strip_bent strip_buckled
                   euler_column springs_buckled tied_column shaft sliding held cantilever)
