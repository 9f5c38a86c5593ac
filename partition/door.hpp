// How ranks leave a job that failed.
#pragma once

#include "communicator.hpp"

namespace balocco {

/// The way out for ranks on which something failed. Errors ought to be shared (Communicator::together), but one that a single rank
/// threw must not leave the others waiting in a collective: whoever fails asks here whether all do. Made by all ranks together.
class Door {
 public:
  explicit Door(const Communicator& communicator);
  ~Door();
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;

  /// True once every rank has asked; false if some have not within `seconds`: then they run on, and the job has to be aborted.
  bool everyone_comes(double seconds);

 private:
  MPI_Comm handle_ = MPI_COMM_NULL;
  MPI_Request request_ = MPI_REQUEST_NULL;
};

}  // namespace balocco
