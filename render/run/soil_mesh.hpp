// Triangles over the particles of a run and the outlines of its soils, to draw smooth fields on.
#pragma once

#include <array>
#include <vector>

#include "solver/analysis/sampler.hpp"
#include "solver/case/case.hpp"

namespace porosph::render {

/// Each soil has triangles of its own, up to its outline, so that what jumps between soils is drawn with a
/// jump. Where soil has been torn or turned over there are none.
class SoilMesh {
 public:
  /// `starts`: at t = 0; `positions`: present ones, one per particle [m]. Without a case one soil is assumed,
  /// which ends at the outermost particles. Throws std::runtime_error for places that are not finite.
  SoilMesh(const Case* scene, const std::vector<Point>& starts, const std::vector<Point>& positions,
           double spacing);

  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  /// Particles in no triangle, or beside a torn one.
  const std::vector<bool>& uncovered() const { return uncovered_; }

  /// Values at the corners of the triangles from values of particles: those of the particles, and on outlines
  /// by moving least squares over particles of the same soil.
  std::vector<double> at_corners(const std::vector<double>& particle_values) const;
  std::vector<Point> at_corners(const std::vector<Point>& particle_places,
                                const std::vector<Point>& starts) const;

 private:
  struct Border {
    std::vector<std::size_t> particles;  ///< of the soil
    std::vector<Point> starts;           ///< corners on its outline, at t = 0 [m]
    Sampler sample;                      ///< from values of those particles
  };
  void add_soil(const SoilCase* soil, const std::vector<std::size_t>& particles,
                const std::vector<Point>& starts, double spacing, double smoothing_length);
  void remove_torn(const std::vector<Point>& starts, const std::vector<Point>& positions, double spacing);

  std::size_t particle_count_ = 0;
  std::vector<Border> borders_;  ///< their corners come after the particles, in this order
  std::vector<std::array<int, 3>> triangles_;
  std::vector<bool> uncovered_;
};

}  // namespace porosph::render
