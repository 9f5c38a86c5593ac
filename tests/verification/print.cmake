# The tables of JOB.dat.
verification_cases(print 120 tables section requests in_explicit_steps restart)
