// Flowing soil next to fixed walls: it slides over images that do not move with it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/sph/consistent/loose_particles.hpp"
#include "solver/sph/consistent/reference.hpp"

namespace porosph {

/// Its law sees the shear against the images, but its neighbours stay in place: F there is carried by the
/// soil alone. The zero-energy control leaves the images out as well, or it would be a strength of the wall;
/// only particles with few neighbours feel them, unless they are loose.
class RowsAtWalls {
 public:
  /// Those of a new reference ...
  void find(const ReferenceConfiguration& reference, const Model& model);
  /// ... and which of them the control blinds, once the loose ones are known.
  void blind(const LooseParticles& loose);

  bool see_fixed(std::size_t a) const { return sees_fixed_[a] != 0; }  ///< images, of particle a
  std::span<const std::uint8_t> see_ghosts() const { return sees_ghosts_; }
  /// Of each particle: in the soil, and its images that move as it does.
  std::span<const std::int32_t> neighbours() const { return neighbours_; }
  std::span<const Mat2> correction() const { return correction_; }  ///< L of eq. (10) by the soil alone
  bool is_blind(std::size_t a) const { return blind_[a] != 0; }

  struct Gradients {
    Mat2 own, with_walls;  ///< by the soil alone, and by images in walls as well
  };
  Gradients gradients(const ReferenceConfiguration& reference, std::span<const Vec2> velocities,
                      std::int32_t a) const;  ///< of the velocity of particle a [1/s]

  /// The velocities that what follows is of.
  void take_velocities(const ReferenceConfiguration& reference, const Particles& particles);
  /// Carries F over a step dt [s] by the soil alone. Returns the largest |F - I| there.
  double deform(double dt, const LooseParticles& loose, PlaneTensors& deformation) const;
  /// Takes the images out of the control, whose `viscosity` mu is that of each particle [Pa s]: puts the
  /// soil's own gradient into the `flux` of each blind particle, after a step ...
  void leave_out(const ReferenceConfiguration& reference, std::span<const double> viscosity,
                 PlaneTensors& flux, std::span<Record> records) const;
  /// ... and takes the walls' pairs out of the accelerations [m/s2].
  void leave_out(const ReferenceConfiguration& reference, const Particles& particles,
                 std::span<const double> viscosity, std::span<Vec2> accelerations) const;

 private:
  std::vector<Mat2> correction_;
  std::vector<std::int32_t> neighbours_, in_soil_;  ///< the second without images
  std::vector<std::uint8_t> sees_ghosts_, sees_fixed_, blind_;
  std::vector<std::int32_t> particles_;  ///< of flowing soil, that see fixed images
  std::vector<Gradients> gradient_;      ///< of each of those
};

/// Whether point b is soil: a particle, or its image at a periodic side, where the soil continues.
inline bool is_soil(const ReferenceConfiguration& r, std::int32_t b) {
  const std::size_t n = r.particles();
  if (static_cast<std::size_t>(b) < n) return true;
  return r.ghosts.wall(b - n).is_periodic() && is_soil(r, r.ghosts.image(b - n).parent);
}

/// Whether point b is an image in a wall that holds soil fast, or the continuation of one at a periodic side.
inline bool is_fixed_image(const ReferenceConfiguration& r, std::int32_t b) {
  const std::size_t n = r.particles();
  if (static_cast<std::size_t>(b) < n) return false;
  const Wall& wall = r.ghosts.wall(b - n);
  return wall.is_periodic() ? is_fixed_image(r, r.ghosts.image(b - n).parent)
                            : wall.support().carries_shear();
}

}  // namespace porosph
