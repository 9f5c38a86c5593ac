#include "communicator.hpp"

#include <algorithm>
#include <array>
#include <exception>

#include "model/diagnostics.hpp"

namespace balocco {

namespace {

enum class Failure : std::int64_t { none, input, analysis, system };

/// What went wrong on one rank; several messages only for input errors.
struct Report {
  Failure kind = Failure::none;
  std::vector<std::string> messages;
};

Report run(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return {Failure::input, error.messages()};
  } catch (const AnalysisError& error) {
    return {Failure::analysis, {error.what()}};
  } catch (const std::exception& error) {
    return {Failure::system, {error.what()}};
  }
  return {};
}

void broadcast_from(int rank, std::string& text, MPI_Comm handle) {
  auto length = static_cast<std::int64_t>(text.size());
  MPI_Bcast(&length, 1, MPI_INT64_T, rank, handle);
  text.resize(static_cast<std::size_t>(length));
  constexpr std::int64_t piece = 1 << 30;  // a message counts in int, and a deck may be longer
  for (std::int64_t sent = 0; sent < length; sent += piece)
    MPI_Bcast(text.data() + sent, static_cast<int>(std::min(piece, length - sent)), MPI_CHAR, rank, handle);
}

[[noreturn]] void raise(const Report& report) {
  const std::string first = report.messages.empty() ? std::string() : report.messages.front();
  if (report.kind == Failure::input) throw InputError(report.messages);
  if (report.kind == Failure::analysis) throw AnalysisError(first);
  throw SystemError(first);
}

}  // namespace

Communicator::Communicator(MPI_Comm handle) : handle_(handle) {
  MPI_Comm_rank(handle_, &rank_);
  MPI_Comm_size(handle_, &size_);
}

double Communicator::minimum(double value) const {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MIN, handle_);
  return value;
}

double Communicator::maximum(double value) const {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, handle_);
  return value;
}

std::int64_t Communicator::sum(std::int64_t value) const {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_SUM, handle_);
  return value;
}

bool Communicator::any(bool value) const {
  int flag = value ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &flag, 1, MPI_INT, MPI_MAX, handle_);
  return flag != 0;
}

void Communicator::sum(std::span<double> values) const {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, handle_);
}

void Communicator::maximum(std::span<double> values) const {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX, handle_);
}

void Communicator::sum(std::span<ExactSum> sums) const {
  // An accumulator is nothing but its words, so that an array of them travels as it lies.
  static_assert(sizeof(ExactSum) == ExactSum::word_count * sizeof(std::int64_t));
  if (sums.empty() || size_ == 1) return;
  MPI_Allreduce(MPI_IN_PLACE, sums.front().words().data(), static_cast<int>(sums.size() * ExactSum::word_count),
                MPI_INT64_T, MPI_SUM, handle_);
}

Communicator::Located Communicator::minimum(Located local) const {
  const double value = minimum(local.value);
  // Ranks that do not hold the minimum stand back with the largest payload there is.
  std::int64_t payload = local.value == value ? local.payload : INT64_MAX;
  MPI_Allreduce(MPI_IN_PLACE, &payload, 1, MPI_INT64_T, MPI_MIN, handle_);
  return {value, payload};
}

void Communicator::broadcast(std::string& text) const {
  broadcast_from(0, text, handle_);
}

void Communicator::together(const std::function<void()>& work) const {
  Report report = run(work);
  int failing = report.kind == Failure::none ? size_ : rank_;
  MPI_Allreduce(MPI_IN_PLACE, &failing, 1, MPI_INT, MPI_MIN, handle_);
  if (failing == size_) return;
  std::array<std::int64_t, 2> header{static_cast<std::int64_t>(report.kind),
                                     static_cast<std::int64_t>(report.messages.size())};
  MPI_Bcast(header.data(), 2, MPI_INT64_T, failing, handle_);
  report.kind = static_cast<Failure>(header[0]);
  report.messages.resize(static_cast<std::size_t>(header[1]));
  for (auto& message : report.messages) broadcast_from(failing, message, handle_);
  raise(report);
}

}  // namespace balocco
