#include "signals.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <fstream>

namespace balocco {

namespace {

std::atomic<int> stop_signals{0};
std::atomic<bool> frame_signal{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void note_stop(int number) {
  // Someone who presses Ctrl-C again does not want to wait for the checkpoint.
  if (number == SIGINT && stop_signals.load() > 0) std::signal(SIGINT, SIG_DFL);
  stop_signals.fetch_add(1);
}

void note_frame(int) { frame_signal.store(true); }

void handle(int number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, nullptr);
}

void read_words(const std::string& control_file, Requests& requests) {
  std::ifstream file(control_file);
  if (!file) return;
  for (std::string word; file >> word;) {
    requests.stop |= word == "stop";
    requests.checkpoint |= word == "checkpoint";
    requests.frame |= word == "frame";
    requests.info |= word == "info";
  }
  file.close();
  std::remove(control_file.c_str());
}

}  // namespace

void install_signal_handlers() {
  for (int number : {SIGTERM, SIGINT, SIGUSR1}) handle(number, note_stop);
  handle(SIGUSR2, note_frame);
}

Requests take_requests(const Communicator& communicator, const std::string& control_file) {
  Requests mine;
  mine.stop = stop_signals.load() > 0;
  mine.frame = frame_signal.exchange(false);
  if (communicator.is_root()) read_words(control_file, mine);
  std::array<int, 4> flags{mine.stop, mine.checkpoint, mine.frame, mine.info};
  MPI_Allreduce(MPI_IN_PLACE, flags.data(), 4, MPI_INT, MPI_MAX, communicator.handle());
  return {flags[0] != 0, flags[1] != 0, flags[2] != 0, flags[3] != 0};
}

}  // namespace balocco
