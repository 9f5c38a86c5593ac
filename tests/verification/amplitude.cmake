# Loads and motions with an amplitude in the steps behind theirs, on one and on two ranks.
verification_cases(amplitude 120 explicit implicit)
