// The loads of a case, shared out to the particles on the surface.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/boundary/load.hpp"
#include "solver/case/case.hpp"
#include "solver/model/model.hpp"

namespace porosph {

/// What a load acts on: the surface at the start, in parts that its particles carry.
struct LoadedParticles {
  std::shared_ptr<const Load> load;
  std::vector<std::int32_t> particles;  ///< that carry it
  std::vector<Vec2> places;             ///< of each on the stretch [m]
  std::vector<Vec2> normals;            ///< of each, out of the soil
  std::vector<double> areas;            ///< of each, per metre of thickness [m]
};

/// The surface vector n_a of each particle [m]: minus its force under a unit pressure everywhere, by the
/// case's own form, as if there were no sheets. A traction sigma n_a is then in balance with a uniform stress
/// sigma to rounding.
std::vector<Vec2> surface_vectors(const Case& scene, const Model& model);

/// The same with both faces of all sheets.
std::vector<Vec2> vectors_with_sheets(const Case& scene, const Model& model);

/// The particles whose surface lies on a straight stretch of the outline. Where the outline turns by less
/// than 45 degrees beside it, as a curve of short stretches does, each has its own normal, that of its
/// surface.
struct StretchOfParticles {
  std::vector<std::int32_t> particles;
  std::vector<double> along;  ///< of each, from the stretch's beginning [m]
  std::vector<Vec2> normals;  ///< of each, as in LoadedParticles
  std::vector<double> areas;  ///< of each [m]
};
/// How what acts on a stretch ends within a face.
enum class Ends {
  sharp,   ///< of a particle's width only the part on the stretch belongs to it
  spread,  ///< over the particles next to the end, so that their motion does not alternate
};
StretchOfParticles particles_on(const Point& start, const Point& end, const Vec2& normal, const Case& scene,
                                const Model& model, std::span<const Vec2> surface_vectors, Ends ends);

/// Throws std::runtime_error where no particle is near a load's stretch.
std::vector<LoadedParticles> surface_loads(const Case& scene, const Model& model);

/// Adds what the loads do at a time [s] to the accelerations [m/s2].
void add_surface_loads(std::span<const LoadedParticles> loads, const Particles& particles, double time,
                       std::span<Vec2> accelerations);

/// Minus the loads' forces times what they have moved [J/m].
double load_energy(std::span<const LoadedParticles> loads, const Particles& particles, double time);

/// Sum of the squares of the loads' forces on the particles [N2/m2].
double load_squares(std::span<const LoadedParticles> loads, double time);

}  // namespace porosph
