# Read by ctest before it starts the tests: many short runs, which are to start fast. An MPI that does not know these names does without.
set(ENV{OMPI_MCA_mpi_yield_when_idle} 1)     # two tests share the cores: ranks give way while they wait
set(ENV{OMPI_MCA_pml} ob1)                   # ranks of one machine speak through its memory: look for no network, whose libraries
set(ENV{OMPI_MCA_btl} self,vader)            # measure clocks for a tenth of a second when they are loaded
