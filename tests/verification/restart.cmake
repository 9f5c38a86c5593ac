# *RESTART, READ: more and longer steps behind the checkpoint of another job, with the bits of one deck.
verification_cases(restart 120 more_steps longer_step ended_step tumbling kept_states refusals)
