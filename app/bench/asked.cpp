#include "app/bench/asked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace porosph::bench {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr double million = 1e6;

/// `reached`: 1 is exactly what was asked, more is better.
void put(Rows& rows, const std::string& what, const std::string& asked, const std::string& measured,
         double reached) {
  rows.push_back({what, asked, measured, fmt::format("{:.2f}", reached)});
}

void put_ratio(Rows& rows, const Throughput& t, std::int64_t particles, double asked) {
  const ThroughputPoint* p = t.find(default_contender, 1, particles);
  if (p && p->ratio_to_plain.median > 0)
    put(rows, fmt::format("particle-steps per second against plain loops, {} particles", p->particles),
        fmt::format("at least {:g} times", asked), text(p->ratio_to_plain), p->ratio_to_plain.median / asked);
}

void put_rates(Rows& rows, const Throughput& t) {
  constexpr double asked = 12;
  for (const char* form :
       {"consistent (default)", "proposed, eq. (24)", "conventional, eq. (17)", "rho squared, eq. (25)"})
    if (const ThroughputPoint* p = t.find(form, 1, 10'000)) {
      const double least = form == default_contender ? asked : asked / 2;
      put(rows, fmt::format("{}, {} particles", form, p->particles),
          fmt::format("at least {:g} M particle-steps/s", least),
          text({p->rate.median / million, p->rate.low / million, p->rate.high / million}),
          p->rate.median / million / least);
    }
}

void put_threads(Rows& rows, const Throughput& t, int threads) {
  const ThroughputPoint *one = t.find(default_contender, 1, 100'000),
                        *several = t.find(default_contender, threads, 100'000);
  if (threads < 2 || !one || !several) return;
  const double gain = several->rate.median / one->rate.median, asked = 0.9 * threads;
  put(rows, fmt::format("{} threads against 1, {} particles", threads, one->particles),
      fmt::format("at least {:g} times", asked), fmt::format("{:.2f} times", gain), gain / asked);
}

void put_growth(Rows& rows, const Throughput& t) {
  const ThroughputPoint *few = t.find(default_contender, 1, 10'000),
                        *many = t.find(default_contender, 1, 1'000'000);
  if (!few || !many) return;
  const double growth = few->rate.median / many->rate.median;
  put(rows, "cost per particle-step at 10^6 against 10^4 particles", "at most 1.4 times",
      fmt::format("{:.2f} times", growth), 1.4 / growth);
}

void put_memory(Rows& rows, const Throughput& t) {
  for (const char* form : {"consistent (default)", "proposed, eq. (24)"})
    for (std::int64_t n : {1'000'000, 100'000})
      if (const ThroughputPoint* p = t.find(form, 1, n)) {
        put(rows, fmt::format("memory, {}, {} particles", form, p->particles),
            "at most 1000 bytes per particle", fmt::format("{:.0f} bytes", p->bytes_per_particle),
            1000 / p->bytes_per_particle);
        break;
      }
}

void put_refresh(Rows& rows, const WorkPrecision& work) {
  const WorkPoint *default_one = work.find("column", consistent_form, rest_strategy, 0.2),
                  *every_step = work.find("column", consistent_form, refresh_strategy, 0.2);
  if (!default_one || !every_step) return;
  const double change = std::abs(default_one->error / every_step->error - 1);
  put(rows, "error with geometry refreshed when due against every step, column", "changed by at most 2 %",
      fmt::format("{:.2g} % (from {:.4g} % to {:.4g} %)", 100 * change, 100 * every_step->error,
                  100 * default_one->error),
      0.02 / change);
}

/// The fastest run that is accurate enough, or else the most accurate one; null without any.
const WorkPoint* best_of(const WorkPrecision& work, const std::string& scene, double accurate) {
  const WorkPoint* best = nullptr;
  for (const WorkPoint& p : work.points) {
    if (p.scene != scene || p.form != consistent_form || p.ending != "equilibrium") continue;
    const bool enough = p.error <= accurate, best_enough = best && best->error <= accurate;
    if (!best || (enough && !best_enough) || (enough && p.work().median < best->work().median) ||
        (!enough && !best_enough && p.error < best->error))
      best = &p;
  }
  return best;
}

void put_work(Rows& rows, const WorkPrecision& work, const std::string& scene) {
  constexpr double accurate = 1e-3, faster = 100;
  const WorkPoint *paper = work.find(scene, plain_form, paper_strategy, 0.2),
                  *best = best_of(work, scene, accurate);
  if (!paper || !best) return;
  const double gain = paper->work().median / best->work().median;
  put(rows,
      fmt::format(
          "{}: time of the paper's procedure to its {:.2g} % ({:.3g} s) against ours to {:.2g} % ({:.3g} s)",
          scene, 100 * paper->error, paper->work().median, 100 * best->error, best->work().median),
      "100 times, with at most 0.1 %",
      fmt::format("{:.0f} times{}", gain, best->error <= accurate ? "" : ", 0.1 % not reached"),
      gain / faster);
}

/// Finite elements that are at least as accurate as our best.
void put_fem(Rows& rows, const WorkPrecision& work) {
  const WorkPoint* best = best_of(work, "embankment", 1e-3);
  const WorkPoint* fem = nullptr;
  for (const WorkPoint& p : work.points)
    if (best && p.scene == "embankment" && p.form == fem_form && p.error <= best->error &&
        (!fem || p.work().median < fem->work().median))
      fem = &p;
  if (!fem) return;
  const double gain = fem->work().median / best->work().median;
  put(rows,
      fmt::format(
          "embankment: time of finite elements to {:.2g} % ({:.3g} s) against ours to {:.2g} % ({:.3g} s)",
          100 * fem->error, fem->work().median, 100 * best->error, best->work().median),
      "a line to beat", fmt::format("{:.2g} times", gain), gain);
}

}  // namespace

Rows asked_table(const std::optional<Throughput>& throughput, const std::optional<WorkPrecision>& work,
                 int threads) {
  Rows rows = {{"What", "Asked", "Measured", "Reached (1: as asked)"}};
  if (throughput) {
    put_ratio(rows, *throughput, 3750, 12);
    put_ratio(rows, *throughput, 1'000'000, 8);
    put_rates(rows, *throughput);
    put_threads(rows, *throughput, threads);
    put_growth(rows, *throughput);
    put_memory(rows, *throughput);
  }
  if (work) {
    put_refresh(rows, *work);
    put_work(rows, *work, "foundation");
    put_work(rows, *work, "embankment");
    put_fem(rows, *work);
  }
  return rows;
}

}  // namespace porosph::bench
