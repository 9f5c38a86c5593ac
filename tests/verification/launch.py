"""How the tests start the program."""
import atexit
import contextlib
import os
import shutil
import tempfile

# A rank by itself needs no daemon, but a folder for Open MPI's files of its own: tests run side by side.
FOLDER = tempfile.mkdtemp(prefix="balocco_")
atexit.register(shutil.rmtree, FOLDER, ignore_errors=True)
os.environ["OMPI_MCA_orte_tmpdir_base"] = FOLDER
os.environ["OMPI_MCA_ess_singleton_isolated"] = "1"


@contextlib.contextmanager
def environment_of_its_own():
    """The environment of a run that others of the same script run beside."""
    folder = tempfile.mkdtemp(dir=FOLDER)
    try:
        yield os.environ | {"OMPI_MCA_orte_tmpdir_base": folder}
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def on_ranks(ranks):
    """What to write before the program: nothing for one rank, which takes half the time to start without mpirun."""
    return ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(ranks)] if int(ranks) > 1 else []
