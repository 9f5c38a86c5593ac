#include "halo.hpp"

#include <algorithm>
#include <utility>

namespace balocco {

namespace {

constexpr std::size_t components = 3;

double* pack(const std::vector<std::int32_t>& nodes, const double* values, double* out) {
  for (const std::int32_t node : nodes)
    for (std::size_t c = 0; c < components; ++c) *out++ = values[4 * static_cast<std::size_t>(node) + c];
  return out;
}

const double* add(const std::vector<std::int32_t>& nodes, const double* in, double* values) {
  for (const std::int32_t node : nodes)
    for (std::size_t c = 0; c < components; ++c) values[4 * static_cast<std::size_t>(node) + c] += *in++;
  return in;
}

}  // namespace

Halo::Halo(const Communicator& communicator, std::vector<SharedNodes> neighbours, std::int32_t turning, Tag tag,
           std::size_t fields)
    : fields_(fields), neighbours_(std::move(neighbours)) {
  const std::size_t count = neighbours_.size();
  turning_.resize(count);
  outgoing_.resize(count);
  incoming_.resize(count);
  requests_.resize(2 * count, MPI_REQUEST_NULL);
  for (std::size_t i = 0; i < count; ++i) {
    for (const auto node : neighbours_[i].nodes)
      if (node < turning) turning_[i].push_back(node);
    const std::size_t length = components * fields_ * (neighbours_[i].nodes.size() + turning_[i].size());
    outgoing_[i].resize(length);
    incoming_[i].resize(length);
    MPI_Recv_init(incoming_[i].data(), static_cast<int>(length), MPI_DOUBLE, neighbours_[i].rank, static_cast<int>(tag),
                  communicator.handle(), &requests_[i]);
    MPI_Send_init(outgoing_[i].data(), static_cast<int>(length), MPI_DOUBLE, neighbours_[i].rank, static_cast<int>(tag),
                  communicator.handle(), &requests_[count + i]);
  }
}

Halo::~Halo() {
  for (auto& request : requests_) MPI_Request_free(&request);
}

void Halo::begin_sum(std::span<const NodalForces> fields) {
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    double* out = outgoing_[i].data();
    for (const auto& [force, moment] : fields.first(fields_)) {
      out = pack(neighbours_[i].nodes, force, out);
      if (moment != nullptr) out = pack(turning_[i], moment, out);
    }
  }
  if (!requests_.empty()) MPI_Startall(static_cast<int>(requests_.size()), requests_.data());
}

void Halo::finish_sum(std::span<const NodalForces> fields) {
  if (!requests_.empty()) MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    const double* in = incoming_[i].data();
    for (const auto& [force, moment] : fields.first(fields_)) {
      in = add(neighbours_[i].nodes, in, force);
      if (moment != nullptr) in = add(turning_[i], in, moment);
    }
  }
}

void copy_from_owners(const Communicator& communicator, const std::vector<SharedNodes>& neighbours, const std::vector<bool>& owned,
                      std::span<double> values) {
  constexpr int width = 4, tag = static_cast<int>(Halo::Tag::owners);
  std::vector<std::vector<double>> outgoing(neighbours.size()), incoming(neighbours.size());
  std::vector<MPI_Request> requests(2 * neighbours.size(), MPI_REQUEST_NULL);
  const auto exists = [&](std::int32_t node) { return width * static_cast<std::size_t>(node) < values.size(); };
  const auto of = [&](std::int32_t node) { return values.subspan(width * static_cast<std::size_t>(node), width); };
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const auto& [rank, nodes] = neighbours[i];
    for (const auto node : nodes)
      if (exists(node)) outgoing[i].insert(outgoing[i].end(), {owned[node] ? 1.0 : 0.0, of(node)[0], of(node)[1], of(node)[2], of(node)[3]});
    incoming[i].resize(outgoing[i].size());
    const auto count = static_cast<int>(outgoing[i].size());
    MPI_Irecv(incoming[i].data(), count, MPI_DOUBLE, rank, tag, communicator.handle(), &requests[2 * i]);
    MPI_Isend(outgoing[i].data(), count, MPI_DOUBLE, rank, tag, communicator.handle(), &requests[2 * i + 1]);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const double* in = incoming[i].data();
    for (const auto node : neighbours[i].nodes) {
      if (!exists(node)) continue;
      if (*in == 1.0) std::copy_n(in + 1, width, of(node).begin());
      in += 1 + width;
    }
  }
}

}  // namespace balocco
