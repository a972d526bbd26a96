// Signs that a run has broken down.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/model/model.hpp"

namespace porosph {

/// The first particle that is not finite or moves faster than the fastest wave, in words; empty when there is
/// none.
std::optional<std::string> find_runaway(const Model& model, double time);

/// Groups of particles that hang together: chains of distances below the kernel's support. Group number per
/// particle.
struct Bodies {
  std::int64_t count = 0;
  std::vector<std::int32_t> body;
};
Bodies find_bodies(std::span<const Vec2> positions, double support);

/// In words, which particles have left the bodies that were there at first; empty while none has.
std::optional<std::string> find_separation(const Model& model, std::int64_t bodies_at_start, double time);

}  // namespace porosph
