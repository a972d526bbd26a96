#include "app/bench/throughput.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/bench/machine.hpp"
#include "app/bench/roofline.hpp"

namespace porosph::bench {
namespace {

constexpr std::int64_t all_contenders_up_to = 200'000, plain_up_to = 2'000'000;
constexpr std::int64_t memory_tells_from = 50'000;  ///< below, the growth of memory is mostly chance

std::vector<Contender> contenders() {
  const auto form = [](const char* name) { return std::vector{std::string("formulation.motion=") + name}; };
  return {{.name = plain_contender, .overrides = form("proposed"), .plain = true},
          {.name = default_contender, .overrides = {}, .all_threads = true},
          {.name = "proposed, eq. (24)", .overrides = form("proposed"), .all_threads = true},
          {.name = "conventional, eq. (17)", .overrides = form("conventional"), .all_sizes = false},
          {.name = "rho squared, eq. (25)", .overrides = form("rho_squared"), .all_sizes = false}};
}

/// The foundation is 15 m x 10 m: 3 k columns of 2 k rows.
std::vector<int> sizes(const Bench& bench) {
  std::vector<int> all = {13, 25, 41, 129, 408, 1290};
  if (!bench.options().quick) all = {13, 25, 41, 73, 129, 229, 408, 1290};
  std::erase_if(all, [&](int k) { return 6LL * k * k > bench.options().particles; });
  return all;
}

/// One contender at work, and how fast it was in each round.
struct Run {
  Contender contender;
  std::unique_ptr<Simulation> simulation;
  double bytes = 0;                          ///< resident memory that it took
  double step_seconds = 0;                   ///< about
  std::map<int, std::vector<double>> rates;  ///< by threads

  double particles() const { return static_cast<double>(simulation->model().particles.size()); }

  void start(const Bench& bench, int k) {
    release_free_memory();
    const auto before = resident_memory();
    std::vector<std::string> overrides = contender.overrides;
    overrides.push_back(fmt::format("particles.spacing={:.17g}", 5.0 / k));
    const Case scene = read(bench, "foundation.toml", overrides);
    simulation = contender.plain ? std::make_unique<Simulation>(scene, make_plain_dynamics)
                                 : std::make_unique<Simulation>(scene);
    simulation->advance();  // makes lists and gradients
    release_free_memory();
    bytes = static_cast<double>(resident_memory() - before);
    step_seconds = timed([&] { simulation->advance(); }).cpu;
  }

  /// Not much longer than this even where other programs hold a thread up.
  void slice(int threads, double seconds) {
    omp_set_num_threads(threads);
    const auto wanted = std::max<std::int64_t>(1, std::llround(seconds / step_seconds));
    std::int64_t steps = 0;
    const Seconds start = now();
    while (steps < wanted && (steps == 0 || (now() - start).wall < 3 * seconds))
      simulation->advance(), ++steps;
    const Seconds t = now() - start;
    omp_set_num_threads(1);
    if (simulation->instability())
      throw std::runtime_error(contender.name + ": " + simulation->instability()->message);
    rates[threads].push_back(particles() * static_cast<double>(steps) / t.of(threads));
    if (threads == 1) step_seconds = t.cpu / static_cast<double>(steps);
  }
};

std::vector<int> thread_counts(const Contender& c, const Bench& bench) {
  if (!c.all_threads || bench.options().threads == 1) return {1};
  return {1, bench.options().threads};
}

std::vector<double> ratios(const std::vector<double>& rates, const Run* plain) {
  if (!plain) return {0};
  std::vector<double> result;
  for (std::size_t i = 0; i < rates.size(); ++i) result.push_back(rates[i] / plain->rates.at(1)[i]);
  return result;
}

/// The particles' numbers of contenders that are started together.
std::vector<Contender> at_size(std::int64_t particles) {
  std::vector<Contender> chosen = contenders();
  std::erase_if(chosen, [&](const Contender& c) {
    return (particles > all_contenders_up_to && !c.all_sizes) ||
           (particles > plain_up_to && c.name != default_contender);
  });
  return chosen;
}

/// Rounds of slices of every contender at one number of particles.
std::vector<ThroughputPoint> measure_at(Bench& bench, int k) {
  const auto n = static_cast<std::int64_t>(6) * k * k;
  std::vector<Run> runs;
  for (const Contender& c : at_size(n)) {
    runs.push_back({.contender = c, .simulation = nullptr, .rates = {}});
    runs.back().start(bench, k);
  }
  const int rounds = bench.options().quick || n > plain_up_to ? 3 : 5;
  const double slice = bench.options().quick ? 0.06 : 0.2;
  for (int round = 0; round < rounds; ++round)
    for (Run& run : runs)
      for (int threads : thread_counts(run.contender, bench)) run.slice(threads, slice);

  const auto plain = std::find_if(runs.begin(), runs.end(), [](const Run& r) { return r.contender.plain; });
  std::vector<ThroughputPoint> points;
  for (const Run& run : runs)
    for (const auto& [threads, rates] : run.rates) {
      ThroughputPoint p{.contender = run.contender.name,
                        .threads = threads,
                        .particles = static_cast<std::int64_t>(run.particles()),
                        .rate = spread_of(rates),
                        .ratio_to_plain = spread_of(ratios(rates, plain == runs.end() ? nullptr : &*plain))};
      if (n >= memory_tells_from) p.bytes_per_particle = run.bytes / run.particles();
      points.push_back(p);
    }
  return points;
}

/// Bytes per particle of the default at the largest size where it could be told.
double usual_bytes(const std::vector<ThroughputPoint>& points) {
  double bytes = 1000;
  for (const ThroughputPoint& p : points)
    if (p.contender == default_contender && p.bytes_per_particle > 0) bytes = p.bytes_per_particle;
  return bytes;
}

/// Building, warming up and the slices themselves, from what the size before took [s].
double expected_seconds(double last_seconds, std::int64_t last, std::int64_t particles) {
  const auto work = [](std::int64_t n) {
    return static_cast<double>(n) * static_cast<double>(at_size(n).size());
  };
  return last_seconds * work(particles) / work(last);
}

void add_ceilings(std::vector<ThroughputPoint>& points, const Bench& bench) {
  const double seconds = bench.options().quick ? 0.05 : 0.2;
  const double bytes = usual_bytes(points);
  for (ThroughputPoint& p : points) {
    if (p.contender != default_contender) continue;
    const double all = std::min(bytes * static_cast<double>(p.particles), 1e9);
    p.ceiling = read_rate(static_cast<std::size_t>(all), p.threads, seconds) / bytes;
  }
}

}  // namespace

const ThroughputPoint* Throughput::find(const std::string& contender, int threads,
                                        std::int64_t near_particles) const {
  const double target = static_cast<double>(near_particles);
  for (const ThroughputPoint& p : points)
    if (p.contender == contender && p.threads == threads &&
        std::abs(static_cast<double>(p.particles) - target) < 0.05 * target)
      return &p;
  return nullptr;
}

Throughput measure_throughput(Bench& bench) {
  omp_set_num_threads(1);
  Throughput throughput;
  double last_seconds = 0;
  std::int64_t last = 1;
  for (int k : sizes(bench)) {
    const auto n = static_cast<std::int64_t>(6) * k * k;
    const std::string what = fmt::format("throughput at {} particles", n);
    // Building needs somewhat more than what stays.
    const double needed = 1.5 * usual_bytes(throughput.points) * static_cast<double>(n) *
                          static_cast<double>(at_size(n).size());
    if (const auto free = static_cast<double>(available_memory()); needed > free) {
      bench.leave_out(what, fmt::format("needs about {:.1f} GB of memory where {:.1f} GB are free",
                                        needed / 1e9, free / 1e9));
      continue;
    }
    // Slices take their time however few the particles are: only large sizes grow with n.
    if (n > 500'000 && !bench.affords(what, expected_seconds(last_seconds, last, n), 0.5)) continue;
    bench.tell(what);
    std::vector<ThroughputPoint> points;
    last_seconds = timed([&] { points = measure_at(bench, k); }).wall;
    last = n;
    throughput.points.insert(throughput.points.end(), points.begin(), points.end());
  }
  bench.tell("roofline");
  add_ceilings(throughput.points, bench);
  throughput.arithmetic = arithmetic_rate(bench.options().quick ? 0.1 : 0.3);
  return throughput;
}

}  // namespace porosph::bench
