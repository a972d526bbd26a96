// Signs that a run has broken down.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/model.hpp"

namespace porosph {

enum class Cause {
  not_finite,   ///< a number of the state is not finite
  too_fast,     ///< a particle outruns the fastest wave
  inverted,     ///< soil turned inside out: a volume that is not positive, or particles that met
  energy_gain,  ///< motion and strain hold energy that came from nowhere
  separated,    ///< particles have left the soil body
};

/// One or two words for tables ("not finite").
std::string_view cause_name(Cause cause);

/// What went wrong first.
struct Breakdown {
  Cause cause = Cause::not_finite;
  std::string message;  ///< for people: when, which particle, where, and the usual reason
};

/// The first particle that is not finite, has no volume left or moves faster than the fastest wave.
std::optional<Breakdown> find_runaway(const Model& model, double time);

/// Groups of particles that hang together: chains of distances below the kernel's support. Group number per
/// particle.
struct Bodies {
  std::int64_t count = 0;
  std::vector<std::int32_t> body;
};
Bodies find_bodies(std::span<const Vec2> positions, double support);

/// Which particles have left the bodies that were there at first; empty while none has.
std::optional<Breakdown> find_separation(const Model& model, std::int64_t bodies_at_start, double time);

}  // namespace porosph
