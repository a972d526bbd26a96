// Which particles have which soil law, as the hot loops see it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "solver/soil/soil.hpp"

namespace porosph {

/// The law of one soil.
struct LawView {
  static constexpr std::size_t most_history = 16;

  std::size_t kind;        ///< its place in Laws; Laws::size where it is an ExternalLaw
  const void* law;         ///< of that type
  double* const* history;  ///< its fields, per particle
  std::size_t history_count;
  bool may_yield;
};

/// Consecutive particles of one soil.
struct SoilRange {
  std::int32_t first, last;  ///< particles first to last - 1
  std::int32_t soil;
  std::int32_t own_side;  ///< where those of the first begin in OwnSideView, or -1: no other soil is near
};

/// Soils of all particles, in order.
struct SoilView {
  const SoilRange* ranges;
  std::int32_t count;
  const LawView* laws;  ///< of each soil
};

}  // namespace porosph
