// How trouble is told. Input errors are collected and thrown together; failures of the analysis are thrown at once.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace balocco {

/// Bad input or usage (exit status 2): one or more whole messages "FILE:LINE: error: *KEYWORD: what is wrong; how to mend it".
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> messages);
  explicit InputError(const std::string& message) : InputError(std::vector<std::string>{message}) {}
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

/// The analysis failed: no convergence, distortion, blown up (exit status 3). Thrown by every rank alike.
class AnalysisError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// File system, MPI or internal trouble (exit status 5).
class SystemError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace balocco
