#include "vtk_io/finished_run/frame_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace porosph {
namespace {

double time_of(const FinishedRun& run, std::size_t frame) { return run.series.frames.at(frame).time; }

/// Times that differ by less count as one [s].
double time_step(const FinishedRun& a, const FinishedRun& b) {
  double step = 0;
  for (const FinishedRun* run : {&a, &b}) {
    const double end = run->series.frames.back().time;
    step = std::max(step, run->summary ? run->summary->time_step : 1e-6 * end);
  }
  return step * (1 + 1e-9);
}

bool is_final_rest(const FinishedRun& run, std::size_t frame) {
  return ends_at_rest(run) && frame + 1 == run.series.frames.size();
}

std::string end_text(const FinishedRun& run) {
  return fmt::format("{} ends at {:.6g} s", run.folder.string(), run.series.frames.back().time);
}

}  // namespace

FramePair last_frames(const FinishedRun& a, const FinishedRun& b) {
  return {a.series.frames.size() - 1, b.series.frames.size() - 1};
}

FramePair frames_at(const FinishedRun& a, const FinishedRun& b, double time) {
  return {frame_at(a.series, time), frame_at(b.series, time)};
}

FramePair common_frames(const FinishedRun& a, const FinishedRun& b) {
  const double step = time_step(a, b);
  for (std::size_t i = a.series.frames.size(); i-- > 1;)
    for (std::size_t k = b.series.frames.size(); k-- > 1;)
      if (std::abs(time_of(a, i) - time_of(b, k)) <= step) return {i, k};
  const double end = std::min(a.series.frames.back().time, b.series.frames.back().time);
  throw std::runtime_error(fmt::format(
      "{} and {}, and they have no frame of the same time but the start: run the longer one with --set "
      "\"output.times=[{}]\"",
      end_text(a), end_text(b), end));
}

bool is_fair(const FinishedRun& a, const FinishedRun& b, const FramePair& frames) {
  return std::abs(time_of(a, frames.a) - time_of(b, frames.b)) <= time_step(a, b) ||
         is_final_rest(a, frames.a) || is_final_rest(b, frames.b);
}

void require_fair(const FinishedRun& a, const FinishedRun& b, const FramePair& frames) {
  if (is_fair(a, b, frames)) return;
  throw std::runtime_error(
      fmt::format("{} would be compared at {:.6g} s with {} at {:.6g} s, neither at rest: choose --time "
                  "common or a time that "
                  "both have frames of (--set output.times=[...] writes one), or --allow-different-times",
                  a.folder.string(), time_of(a, frames.a), b.folder.string(), time_of(b, frames.b)));
}

}  // namespace porosph
