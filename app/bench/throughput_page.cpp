#include <fmt/format.h>

#include <algorithm>

#include "app/bench/csv.hpp"
#include "app/bench/throughput.hpp"
#include "render/chart.hpp"

namespace porosph::bench {

using namespace render;

namespace {

using Rows = std::vector<std::vector<std::string>>;

/// Multiply-adds of a particle's step that its equations need, two operations each: 12 per pair (4 of the
/// strain rate, 8 of stress, pressure and viscosity), about 20 pairs, and about 100 of its own.
constexpr double operations_per_step = 2 * (12 * 20 + 100);

std::string label(const std::string& contender, int threads) {
  return threads == 1 ? contender : fmt::format("{}, {} threads", contender, threads);
}

void write_table(const Throughput& t, const Bench& bench) {
  Rows rows = {{"contender", "threads", "particles", "rate", "rate_low", "rate_high", "ratio_to_plain",
                "ratio_low", "ratio_high", "bytes_per_particle", "memory_ceiling"}};
  for (const ThroughputPoint& p : t.points)
    rows.push_back({p.contender, std::to_string(p.threads), std::to_string(p.particles),
                    digits(p.rate.median), digits(p.rate.low), digits(p.rate.high),
                    digits(p.ratio_to_plain.median), digits(p.ratio_to_plain.low),
                    digits(p.ratio_to_plain.high), digits(p.bytes_per_particle), digits(p.ceiling)});
  write_csv(bench.options().out / "throughput.csv", rows);
}

/// In the order in which they were measured first.
std::vector<std::pair<std::string, int>> lines_of(const Throughput& t) {
  std::vector<std::pair<std::string, int>> lines;
  for (const ThroughputPoint& p : t.points)
    if (std::find(lines.begin(), lines.end(), std::pair(p.contender, p.threads)) == lines.end())
      lines.emplace_back(p.contender, p.threads);
  return lines;
}

void draw(const Throughput& t, const Bench& bench) {
  static constexpr Marker markers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
  Chart chart{
      .title = "Particle-steps per second and the rates that memory and arithmetic allow",
      .x = {.title = "particles", .logarithmic = true},
      .y = {.title = "million particle-steps per second", .logarithmic = true},
      .series = {},
      .references = {{.label = "arithmetic, 1 thread", .y = t.arithmetic / operations_per_step / 1e6}}};
  std::size_t colour = 0, shape = 0;
  std::string contender;
  for (const auto& [name, threads] : lines_of(t)) {
    if (!contender.empty() && name != contender) ++colour;
    contender = name;
    ChartSeries series{.label = label(name, threads), .x = {}, .y = {}};
    series.colour = series_colour(colour);
    series.marker = markers[shape++ % 4];
    if (threads > 1) series.line = LineStyle::dashed;
    for (const ThroughputPoint& p : t.points)
      if (p.contender == name && p.threads == threads)
        series.x.push_back(static_cast<double>(p.particles)), series.y.push_back(p.rate.median / 1e6);
    chart.series.push_back(series);
  }
  for (int threads : {1, bench.options().threads}) {
    ChartSeries ceiling{.label = label("memory, once per step", threads), .x = {}, .y = {}};
    for (const ThroughputPoint& p : t.points)
      if (p.ceiling > 0 && p.threads == threads)
        ceiling.x.push_back(static_cast<double>(p.particles)), ceiling.y.push_back(p.ceiling / 1e6);
    ceiling.colour = Colour{120, 120, 120};
    ceiling.line = threads == 1 ? LineStyle::dotted : LineStyle::dash_dotted;
    if (!ceiling.x.empty()) chart.series.push_back(ceiling);
    if (bench.options().threads == 1) break;
  }
  save_charts({.title = "", .charts = {chart}, .columns = 1, .width = 1100, .height = 560},
              bench.options().out / "throughput.png");
}

Rows rate_table(const Throughput& t) {
  Rows rows = {{"Particles"}};
  std::vector<std::int64_t> sizes;
  for (const ThroughputPoint& p : t.points)
    if (sizes.empty() || sizes.back() != p.particles) sizes.push_back(p.particles);
  for (std::int64_t n : sizes) rows.push_back({std::to_string(n)});
  for (const auto& [name, threads] : lines_of(t)) {
    rows[0].push_back(label(name, threads));
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const ThroughputPoint* p = t.find(name, threads, sizes[i]);
      std::string cell = "–";
      if (p) cell = text({p->rate.median / 1e6, p->rate.low / 1e6, p->rate.high / 1e6});
      rows[i + 1].push_back(cell);
    }
  }
  return rows;
}

Rows ratio_table(const Throughput& t) {
  Rows rows = {{"Way", "Particles", "Times the plain loops", "Bytes per particle"}};
  for (const ThroughputPoint& p : t.points)
    if (p.contender != plain_contender && p.threads == 1 && p.ratio_to_plain.median > 0)
      rows.push_back({p.contender, std::to_string(p.particles), text(p.ratio_to_plain),
                      p.bytes_per_particle > 0 ? fmt::format("{:.0f}", p.bytes_per_particle) : "–"});
  return rows;
}

}  // namespace

StudySection show_throughput(const Throughput& t, const Bench& bench) {
  write_table(t, bench);
  draw(t, bench);
  return {
      .heading = "Throughput",
      .paragraphs =
          {"Particles that advance by one step in a second, of the foundation at different spacings. The "
           "ways take turns, a slice of time each, in several rounds; shown are the medians and half the "
           "range from the lowest to the highest. With one thread the core's own time counts, with several "
           "the time on the clock.",
           fmt::format(
               "The ceilings are measured in the same run: how often a second the memory that a particle "
               "takes could be read once, and how often the {:.0f} operations that its equations need "
               "could be done by one core's {:.0f} GFLOP/s.",
               operations_per_step, t.arithmetic / 1e9)},
      .tables = {{.caption = "Million particle-steps per second", .rows = rate_table(t)},
                 {.caption = "Against the plain loops of eq. (24), round by round, one thread",
                  .rows = ratio_table(t)}},
      .pictures = {{.file = "throughput.png",
                    .description = "Particle-steps per second over the number of particles",
                    .caption = "Throughput against the number of particles, and what memory and arithmetic "
                               "would allow"}}};
}

}  // namespace porosph::bench
