#include "gather.hpp"

#include <cstdint>
#include <cstring>

namespace balocco {

void merge_bits(std::vector<double>& values, const Communicator& communicator) {
  std::vector<std::uint64_t> bits(values.size()), merged(values.size());
  std::memcpy(bits.data(), values.data(), values.size() * sizeof(double));
  MPI_Reduce(bits.data(), merged.data(), static_cast<int>(bits.size()), MPI_UINT64_T, MPI_BOR, 0,
             communicator.handle());
  std::memcpy(values.data(), merged.data(), values.size() * sizeof(double));
}

}  // namespace balocco
