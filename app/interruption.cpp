#include "app/interruption.hpp"

#include <csignal>
#include <cstdlib>

#include "app/command.hpp"

namespace porosph::app {
namespace {

volatile std::sig_atomic_t signal_caught = 0;

/// A closing terminal may send SIGHUP twice, and a service manager sends it after SIGTERM.
void catch_signal(int signal) {
  if (signal_caught != 0 && signal != SIGHUP) std::_Exit(Exit::interrupted);
  signal_caught = signal;
}

}  // namespace

void catch_interruptions() {
  std::signal(SIGINT, catch_signal);
  std::signal(SIGTERM, catch_signal);
  if (std::signal(SIGHUP, catch_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

bool is_interrupted() { return signal_caught != 0; }

}  // namespace porosph::app
