// Particles of flowing soil that have come off the body: they fly, land and slide as bodies of their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/sph/wall_stop.hpp"

namespace porosph {

/// With hardly a neighbour a particle is not part of a continuum: its velocity gradient is noise, and stress
/// made of that throws it about, the further the stiffer the soil. So a loose particle bears no stress. Its
/// neighbours carry it along by the zero-energy control, and walls stop and hold it.
class LooseParticles {
 public:
  /// Of the soil, that a particle of the body has with a smoothing length of 1.2 spacings. There are fewer
  /// where the kernel reaches less far: with one spacing a row on a wall or a free surface has 5.
  static constexpr int fewest_neighbours = 7;
  /// How near to walls they come, in spacings: at half of one the soil of a loose particle ends. Soil of the
  /// body that has opened bears nothing until that has closed, and could sink through.
  static constexpr double loose_ends = 0.5, body_ends = 0.25;
  static constexpr double nearest = 0.2;  ///< evening out moves none nearer than that

  /// Those of a new reference, by how many particles of the soil each has as neighbours, and whether it has
  /// ghosts among them. None before soil flows, nor of a law whose stiffness follows its state, which cannot
  /// be without stress.
  void take(const Model& model, std::span<const std::int32_t> neighbours,
            std::span<const std::uint8_t> at_walls, bool flows);

  bool soil_has_flowed() const { return flows_; }
  bool is(std::size_t particle) const { return bears_[particle] == 0; }
  const double* bears() const { return bears_.data(); }  ///< as in FlowView

  WallStop& walls() { return walls_; }
  const WallStop& walls() const { return walls_; }

 private:
  std::vector<double> bears_;  ///< 1, or 0 for those that are loose
  WallStop walls_;
  bool flows_ = false;
};

}  // namespace porosph
