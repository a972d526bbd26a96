// How much the soil has been deformed since the start.
#pragma once

#include <span>
#include <vector>

#include "solver/model/model.hpp"

namespace porosph {

/// Symmetric tensor of plane strain; zz is zero [-].
struct Strain {
  double xx = 0, yy = 0, zz = 0, xy = 0;
};

/// Green-Lagrange strain (F^T F - I) / 2 of the displacement since t = 0, one per particle: no rotation
/// strains, and where displacements are small it is the linear strain. F is exact for linear displacements:
/// corrected kernel gradients (eqs. 9 and 10) over the particles' positions at t = 0. Where neighbours do not
/// span the plane it is not a number.
std::vector<Strain> strain_since_start(const Model& model);

/// The same of particles that were at `start` and are at `position` [m]. `volume`: of each [m2].
std::vector<Strain> strain_between(std::span<const Vec2> start, std::span<const Vec2> position,
                                   std::span<const double> volume, double smoothing_length);

}  // namespace porosph
