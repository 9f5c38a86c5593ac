# *SHEAR FAILURE: elements that fail are deleted.
verification_cases(failure 120 pulled preloaded ranks)
