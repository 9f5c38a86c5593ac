"""How the tests start the program."""


def on_ranks(ranks):
    """What to write before the program."""
    return ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(ranks)]
