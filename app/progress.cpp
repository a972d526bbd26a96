#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "app/say.hpp"

namespace porosph::app {
namespace {

std::string clock_text(double seconds) {
  const long s = std::lround(seconds);
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

Progress::Progress(bool quiet, const Simulation& s)
    : first_step_(s.moves()), quiet_(quiet), terminal_(isatty(fileno(stderr)) != 0) {}

void Progress::show(const Simulation& s) {
  const auto now = Clock::now();
  const std::chrono::duration<double> pause = now - last_;
  if (quiet_ || pause.count() < (terminal_ ? 0.2 : 10)) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double steps = static_cast<double>(s.moves() - first_step_);
  const double rate = steps * static_cast<double>(s.model().particles.size()) / elapsed;
  const double left = elapsed * static_cast<double>(s.last_step() - s.step()) / steps;
  if (const Consolidation* c = s.consolidation(); c != nullptr && s.rests_in_flow()) {
    const std::string line =
        fmt::format("t = {:.6g} of {:g} s   flow step {}   {} sweeps   forces {:.1e}", s.time(),
                    s.scene().time.end, c->counts().flow_steps, c->counts().soil_sweeps, c->unbalanced());
    say(stderr, terminal_ ? "\r" + line + "\x1b[K" : line + "\n");
    line_open_ = terminal_;
    return;
  }
  if (s.seepage() != nullptr && s.rests_in_flow()) {
    const std::string line =
        fmt::format("t = {:.6g} of {:g} s   flow step {}   {} sweeps of the soil", s.time(),
                    s.scene().time.end, s.seepage()->richards().counts().steps, s.settling_sweeps());
    say(stderr, terminal_ ? "\r" + line + "\x1b[K" : line + "\n");
    line_open_ = terminal_;
    return;
  }
  if (s.follows_flow()) {
    const std::string line =
        fmt::format("t = {:.6g} of {:g} s   in motion since {:.6g} s   step {}   {:.2f} M particle-steps/s",
                    s.time(), s.scene().time.end, s.failed_at(), s.moves(), rate / 1e6);
    say(stderr, terminal_ ? "\r" + line + "\x1b[K" : line + "\n");
    line_open_ = terminal_;
    return;
  }
  const std::string line =
      fmt::format("t = {:.4f} of {:g} s   step {} of {}   {:.2f} M particle-steps/s   {} left", s.time(),
                  s.scene().time.end, s.step(), s.last_step(), rate / 1e6, clock_text(left));
  say(stderr, terminal_ ? "\r" + line + "\x1b[K" : line + "\n");
  line_open_ = terminal_;
}

void Progress::finish() {
  if (line_open_) say(stderr, "\r\x1b[K");
  line_open_ = false;
}

}  // namespace porosph::app
