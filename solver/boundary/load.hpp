// What every kind of load on the soil's surface offers, and the surface that carries it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solver/particles/particles.hpp"

namespace porosph {

class Load {
 public:
  virtual ~Load() = default;

  /// Force per area of the surface as it is now [Pa], at a place on it [m] where its outward unit normal is
  /// `normal`, at a time [s].
  virtual Vec2 traction(const Vec2& place, const Vec2& normal, double time) const = 0;
};

/// A short piece of the soil's surface, which moves with the particles around it.
struct SurfacePiece {
  std::vector<std::int32_t> particles;         ///< that carry it
  std::vector<double> weight_from, weight_to;  ///< of each: position of the ends, exact for linear fields
};

struct LoadedSurface {
  std::vector<SurfacePiece> pieces;  ///< soil on the left of each, seen from its beginning to its end
  std::shared_ptr<const Load> load;
};

/// The piece from one point to the other, carried by the particles `near` it, with the kernel's h [m].
SurfacePiece surface_piece(const Vec2& from, const Vec2& to, std::span<const std::int32_t> near,
                           const Particles& particles, double smoothing_length);

/// Adds to the accelerations [m/s2] what the loads do to the surfaces as they are at this time [s]. Each
/// piece's force is shared out by the weights that move it, so force and moment are exact.
void add_loads(std::span<const LoadedSurface> surfaces, const Particles& particles, double time,
               std::span<Vec2> accelerations);

}  // namespace porosph
