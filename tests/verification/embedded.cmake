# Elements embedded in solids: the patch test, on one rank and on two.
verification_cases(embedded 60 patch)
