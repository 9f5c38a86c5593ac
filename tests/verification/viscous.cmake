# Laws that know time: Prony series and yield that depends on rates.
verification_cases(viscous 120 closed_loop relaxation free_vibration yield_at_rate)
