// A section through soil as limit equilibrium sees it: vertical strips of layers, ground, floor and water.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph::limit_equilibrium {

/// Mohr and Coulomb's strength: c + (sigma_n - u) tan(phi).
struct Strength {
  double cohesion = 0;      ///< c [Pa]
  double tan_friction = 0;  ///< tan(phi) [-]
};

/// Strength of a soil, whose cohesion may grow with depth: undrained strength of clay.
struct SoilStrength {
  double cohesion = 0;      ///< at `level` and above [Pa]
  double tan_friction = 0;  ///< [-]
  double growth = 0;        ///< of the cohesion with depth below `level` [Pa/m]
  double level = 0;         ///< y [m]

  Strength at(double y) const { return {cohesion + growth * std::max(0.0, level - y), tan_friction}; }
  bool operator==(const SoilStrength&) const = default;
};

struct SectionSoil {
  std::vector<Polygon> outlines;                                  ///< the outline, then its holes [m]
  double unit_weight_saturated = 0, unit_weight_unsaturated = 0;  ///< below and above the water [N/m3]
  std::optional<SoilStrength> strength;                           ///< none: no slip surface passes through it
};

/// A straight piece of the water's surface; pressure below it is hydrostatic, and it loads ground that lies
/// below it.
struct WaterPiece {
  Point from, to;  ///< from.x() < to.x() [m]
};

/// A load on a straight piece of ground, linear from end to end.
struct GroundLoad {
  Point from, to;                    ///< [m]
  Point traction_from, traction_to;  ///< force per area [Pa]
};

/// Whether the upright ends of a section are free faces; soil continues beyond others.
struct FreeEnds {
  bool left = false, right = false;
};

/// Soils and water between neighbouring corners, where all lines are straight. Coordinates in m.
class Section {
 public:
  /// `horizontal`: acceleration to the right over g that acts on the soil and the water in it beside gravity.
  /// Throws std::invalid_argument where a unit weight is not positive.
  Section(std::vector<SectionSoil> soils, std::vector<WaterPiece> water, double water_unit_weight,
          std::vector<GroundLoad> loads = {}, double horizontal = 0, FreeEnds free = {});

  /// The same section seen from behind: x becomes -x.
  Section mirrored() const;

  static constexpr int nothing = -1;  ///< in place of a soil's number

  /// A layer of one soil between two upright lines.
  struct Strip {
    double bottom[2], top[2];  ///< y at both ends
    int soil;
  };
  /// What lies between two neighbouring corners; strips upwards, only those that rest on one another from the
  /// ground down.
  struct Column {
    double from, to;
    std::vector<Strip> strips;
    double lowest[2];  ///< y of what no slip surface goes below: the bottom, or soil without a strength
    double water[2];   ///< y of the water's surface at both ends, -never without

    double at(const double (&y)[2], double x) const {
      return y[0] + (y[1] - y[0]) * (x - from) / (to - from);
    }
    double ground(double x) const { return at(strips.back().top, x); }
    double floor(double x) const { return at(lowest, x); }
    double water_level(double x) const { return water[0] == -never ? -never : at(water, x); }
    int soil_at(double x, double y) const;  ///< `nothing` above the ground and below the floor
  };

  const std::vector<Column>& columns() const { return columns_; }
  const std::vector<SectionSoil>& soils() const { return soils_; }
  double horizontal() const { return horizontal_; }
  /// The column over x, the left one of two; columns().size() outside.
  std::size_t column_of(double x) const;

  /// What lies between y and the ground over x.
  struct Pillar {
    double weight = 0;  ///< per area [Pa]
    double centre = 0;  ///< y of its middle of mass [m]
  };
  Pillar pillar_above(const Column& column, double x, double y) const;
  /// u >= 0 below the water's surface [Pa].
  double pore_pressure(const Column& column, double x, double y) const;
  /// What the loads do at a place on the ground: force per area [Pa].
  Point traction_at(const Point& place) const;

  /// Unbroken pieces of ground, from left to right; upright steps and free ends are segments of no width.
  const std::vector<Polygon>& grounds() const { return grounds_; }

 private:
  std::vector<double> corners() const;
  Column column_between(double from, double to) const;
  void trace_ground();

  std::vector<SectionSoil> soils_;
  std::vector<WaterPiece> water_;
  double water_unit_weight_;
  std::vector<GroundLoad> loads_;
  double horizontal_;
  FreeEnds free_;
  std::vector<Column> columns_;
  std::vector<Polygon> grounds_;
  double smallest_ = 0;  ///< lengths below this are none [m]
};

}  // namespace porosph::limit_equilibrium
