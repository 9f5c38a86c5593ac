#include "door.hpp"

#include <chrono>
#include <thread>

namespace balocco {

Door::Door(const Communicator& communicator) {
  MPI_Comm_dup(communicator.handle(), &handle_);
}

Door::~Door() {
  if (request_ != MPI_REQUEST_NULL) MPI_Wait(&request_, MPI_STATUS_IGNORE);
  MPI_Comm_free(&handle_);
}

bool Door::everyone_comes(double seconds) {
  MPI_Ibarrier(handle_, &request_);
  const double begin = MPI_Wtime();
  int here = 0;
  for (MPI_Test(&request_, &here, MPI_STATUS_IGNORE); here == 0 && MPI_Wtime() - begin < seconds;
       MPI_Test(&request_, &here, MPI_STATUS_IGNORE))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return here != 0;
}

}  // namespace balocco
