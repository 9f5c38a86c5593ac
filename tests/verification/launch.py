"""How the tests start the program."""


def on_ranks(ranks):
    """What to write before the program: nothing for one rank, which takes half the time to start without mpirun."""
    return ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(ranks)] if int(ranks) > 1 else []
