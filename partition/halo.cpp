#include "halo.hpp"

#include <utility>

namespace balocco {

namespace {
constexpr int halo_tag = 4711;
constexpr std::size_t components = 3;
}  // namespace

Halo::Halo(const Communicator& communicator, std::vector<SharedNodes> neighbours) : neighbours_(std::move(neighbours)) {
  const std::size_t count = neighbours_.size();
  outgoing_.resize(count);
  incoming_.resize(count);
  requests_.resize(2 * count, MPI_REQUEST_NULL);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t length = components * neighbours_[i].nodes.size();
    outgoing_[i].resize(length);
    incoming_[i].resize(length);
    MPI_Recv_init(incoming_[i].data(), static_cast<int>(length), MPI_DOUBLE, neighbours_[i].rank, halo_tag,
                  communicator.handle(), &requests_[i]);
    MPI_Send_init(outgoing_[i].data(), static_cast<int>(length), MPI_DOUBLE, neighbours_[i].rank, halo_tag,
                  communicator.handle(), &requests_[count + i]);
  }
}

Halo::~Halo() {
  for (auto& request : requests_) MPI_Request_free(&request);
}

void Halo::begin_sum(const double* values) {
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    double* out = outgoing_[i].data();
    for (const std::int32_t node : neighbours_[i].nodes)
      for (std::size_t c = 0; c < components; ++c) *out++ = values[4 * static_cast<std::size_t>(node) + c];
  }
  if (!requests_.empty()) MPI_Startall(static_cast<int>(requests_.size()), requests_.data());
}

void Halo::finish_sum(double* values) {
  if (!requests_.empty()) MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    const double* in = incoming_[i].data();
    for (const std::int32_t node : neighbours_[i].nodes)
      for (std::size_t c = 0; c < components; ++c) values[4 * static_cast<std::size_t>(node) + c] += *in++;
  }
}

}  // namespace balocco
