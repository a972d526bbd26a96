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
  beyond_wall,  ///< a particle is behind a wall that held it
  too_stiff,    ///< soil has become stiffer than the time step allows
  not_at_rest,  ///< soil that is to give way slowly does not come to rest: it fails
};

/// One or two words for tables ("not finite").
std::string_view cause_name(Cause cause);

/// What went wrong first.
struct Breakdown {
  Cause cause = Cause::not_finite;
  double time = 0;      ///< when it was found [s]
  std::string message;  ///< for people: when, which particle, where, and Model::usual_cause
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

/// A particle that began in front of a wall and is behind it, by a quarter of the spacing.
std::optional<Breakdown> find_beyond_wall(const Model& model, double time);

/// Soil whose law has made it stiffer than the largest modulus of its case.
std::optional<Breakdown> find_too_stiff(const Model& model, double time);

/// Distance of the two particles that are nearest to each other, at most `radius` [m].
double closest_distance(std::span<const Vec2> positions, double radius);

/// Two particles nearer to each other than `allowed` [m]: the soil between them has been turned inside out.
std::optional<Breakdown> find_crossing(const Model& model, double allowed, double time);

/// What to say when motion and strain hold `gained` of their energy [-] from nowhere: it names the particle
/// with most of it.
Breakdown energy_gain(const Model& model, std::span<const Vec2> velocities, double gained, double time);

}  // namespace porosph
