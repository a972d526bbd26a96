// Sheets: elastic plates that soil presses on and slides along, on both sides.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/model/model.hpp"
#include "solver/particles/state.hpp"
#include "solver/run/beam.hpp"
#include "solver/run/leapfrog.hpp"

namespace porosph {

/// What a sheet hands on to the next stage.
struct SheetState {
  std::vector<double> displacement, velocity;  ///< of the beam's degrees of freedom
  struct Contact {
    int side;           ///< 1: on its left, -1: on its right
    double along, gap;  ///< where, and how far the soil is off [m]
    double pressure;    ///< on it; negative: not known yet [Pa]
  };
  std::vector<Contact> contacts;
};

/// The soil's surface on each side is cut into strips k, one for each row of particles beside it. A strip
/// moves as the mean of its particles by their shares n_a of the surface, and a force on it acts on them in
/// these shares (see Footing), so that
///
///   U_k = U_k* + g_k lambda_k,     g_k = dt gain sum w^2 / m
///
/// at the end of a step, U_k* without the sheet. The beam's degrees of freedom q there follow from
///
///   M / (dt gain) (q - q*) + K q = f - sum_k N_k^T lambda_k
///
/// and from the strips: where one touches, it goes where the beam does, unless that would need tension; along
/// the beam it does as well, unless that would need more than friction allows, which it then has. That is
/// solved at the end of the step, so stiff and light beams need no smaller one. Friction follows the
/// pressure with a delay (see WallFriction).
class Sheet {
 public:
  /// `own`, `outer`: the particles' surface vectors on sheets, and on all other free surfaces [m]. Throws
  /// std::runtime_error where no particle is near.
  Sheet(const SheetCase& sheet, const Case& scene, const Model& model, std::span<const Vec2> own,
        std::span<const Vec2> outer);

  /// Adds to the accelerations [m/s2] what the sheet does to the soil in a step dt [s] that `kick` begins,
  /// and keeps what the step does to the sheet.
  void hold(const Model& model, Kick kick, double dt, std::span<Vec2> accelerations);
  /// Once the soil has moved so.
  void take_step();

  /// Puts it in the soil as it lies, without force, or as it was.
  void place(const Particles& particles, const SheetState* before);
  SheetState state(const Particles& particles) const;

  /// Divides the friction and adhesion that the case gives it.
  void reduce_strength(double factor) { reduction_ = factor; }

  const std::string& name() const { return case_.name; }
  std::span<const std::int32_t> particles() const { return particles_; }
  double squares() const { return now_.squares; }  ///< sum of squares of its forces on the particles

  /// At the beam's nodes.
  struct Profile {
    std::vector<double> along;  ///< from its beginning [m]
    std::vector<Vec2> drawn;    ///< where it was drawn [m]
    std::vector<Vec2> moved;    ///< by how much it has moved since it was placed [m]
    std::vector<Beam::Section> sections;
  };
  Profile profile() const;
  struct Extremes {
    Beam::Section section;    ///< of each quantity the largest by size, with its sign
    double displacement = 0;  ///< [m]
  };
  void visit(StateArchive& state);

 private:
  struct Strip {
    int side;                 ///< 1: soil on the left
    std::size_t first, last;  ///< of particles_
    double along, area;       ///< [m]
    double compliance;        ///< sum w^2 / m [1/kg]
    Beam::Place place;
    Vec2 before = Vec2::Zero();  ///< displacement less the sheet's, (along, across), where they touch [m]
    double pressure = -1;        ///< as friction follows it; negative: not known yet [Pa]
    bool touches = true;
    int slides = 0;  ///< 1, -1: the sheet drags the soil towards its end, its beginning
  };
  struct Beside {
    std::int32_t particle;
    double along, area;  ///< [m]
  };
  /// What a step does.
  struct Step {
    std::vector<double> q, velocity;
    std::vector<Vec2> force;  ///< lambda (along, across) on each strip's soil [N/m]
    std::vector<Vec2> slip;   ///< by which each strip's `before` grows [m]
    std::vector<double> pressure;
    double squares = 0;
    std::vector<Vec2> spread;  ///< weight and water on each element of the beam, (along, across) [Pa]
  };
  /// Strips where nothing held them at the end of the step.
  struct Free {
    std::vector<Vec2> displacement;  ///< less `before`, (along, across) [m]
    std::vector<double> give;        ///< g [m2/N]
    double heavy = 0;                ///< 1 / (dt gain) [1/s2]
    std::vector<double> pull;        ///< on the beam without strips
  };
  void make_strips(int side, const Model& model, const std::vector<double>& areas);
  void add_strip(int side, const Model& model, std::span<const Beside> row);
  std::vector<Vec2> spread_forces(const Model& model) const;
  Vec2 mean(const Strip& strip, std::span<const Vec2> of_particles) const;
  Vec2 local(const Vec2& v) const { return {v.dot(along_), v.dot(across_)}; }
  Vec2 offset(const Strip& strip, const Particles& p, const std::vector<double>& q) const;
  Free free_motion(const Model& model, Kick kick, double dt, std::span<const Vec2> accelerations);
  std::vector<double> solve(const Free& free) const;
  double most_shear(const Strip& strip) const;
  bool change_contacts(const Free& free, const std::vector<double>& q);
  Vec2 force_on(std::size_t strip, const Free& free, const std::vector<double>& q) const;

  SheetCase case_;
  Vec2 along_, across_;  ///< unit vectors; the second to its left
  Beam beam_;
  double reduction_ = 1;
  double memory_;                        ///< time in which friction follows the pressure [s]
  std::vector<std::int32_t> particles_;  ///< strip by strip
  std::vector<double> weights_;
  std::vector<Strip> strips_;
  std::vector<double> q_, velocity_;
  Step now_;
};

Sheet::Extremes extremes_of(const Sheet::Profile& profile);

/// Of a case. Throws std::runtime_error where no particle is near one, or where two, or a footing, hold the
/// same particle.
std::vector<Sheet> make_sheets(const Case& scene, const Model& model);

}  // namespace porosph
