// How long something takes, on the clock and on this thread's core.
#pragma once

#include <time.h>

namespace porosph::bench {

/// `cpu` leaves out the time in which other programs had the core. [s]
struct Seconds {
  double wall = 0, cpu = 0;

  Seconds& operator+=(const Seconds& o) {
    wall += o.wall, cpu += o.cpu;
    return *this;
  }
  Seconds operator-(const Seconds& o) const { return {wall - o.wall, cpu - o.cpu}; }
  /// What counts: with one thread the core's time, with several what has passed until all are done.
  double of(int threads) const { return threads == 1 ? cpu : wall; }
};

inline Seconds now() {
  const auto read = [](clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  return {read(CLOCK_MONOTONIC), read(CLOCK_THREAD_CPUTIME_ID)};
}

/// The time that `work` takes.
template <class Work>
Seconds timed(Work&& work) {
  const Seconds before = now();
  work();
  return now() - before;
}

}  // namespace porosph::bench
