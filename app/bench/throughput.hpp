// How many particles a second advances by a step, against their number.
#pragma once

#include "app/bench/bench.hpp"
#include "app/bench/statistics.hpp"
#include "render/report/study.hpp"

namespace porosph::bench {

/// A way to compute the foundation.
struct Contender {
  std::string name;
  std::vector<std::string> overrides;
  bool plain = false;
  bool all_sizes = true;     ///< else up to 10^5 particles only
  bool all_threads = false;  ///< else one thread only
};

struct ThroughputPoint {
  std::string contender;
  int threads = 1;
  std::int64_t particles = 0;
  Spread rate;                    ///< particle-steps per second; of core time with one thread
  Spread ratio_to_plain;          ///< round by round; zero where the plain loops were left out
  double bytes_per_particle = 0;  ///< resident memory that the simulation took; 0: too few particles to tell
  double ceiling = 0;             ///< the rate at which its memory could be read, once per step; 0: not known
};

struct Throughput {
  std::vector<ThroughputPoint> points;
  double arithmetic = 0;  ///< multiply-adds of one core, two operations each [1/s]

  /// Null where it was not measured.
  const ThroughputPoint* find(const std::string& contender, int threads, std::int64_t near_particles) const;
};

inline const std::string plain_contender = "plain loops", default_contender = "consistent (default)";

/// Interleaved: each round gives every contender a slice of time.
Throughput measure_throughput(Bench& bench);

/// Writes throughput.csv, throughput.png.
render::StudySection show_throughput(const Throughput& throughput, const Bench& bench);

}  // namespace porosph::bench
