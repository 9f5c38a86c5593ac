# Laws that know time: Prony series and yield that depends on rates.
verification_cases(viscous 120 closed_loop)
