// What a case says of water that flows: soils' permeability and retention, and the faces through which it
// enters and leaves.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string_view>

namespace porosph {

/// What the pore water does.
enum class WaterMode {
  still,     ///< it stands under its level: hydrostatic
  steady,    ///< steady seepage between the faces; the soil then carries that flow
  coupled,   ///< saturated soil gives its water away over time: consolidation
  undrained  ///< saturated soil keeps its water
};

/// As in the case file.
constexpr std::string_view name(WaterMode mode) {
  constexpr std::string_view names[] = {"still", "steady", "coupled", "undrained"};
  return names[static_cast<int>(mode)];
}

/// How permeability and saturation fall above the water table.
enum class RetentionModel {
  saturated,      ///< full below the water table; within one spacing above it kr falls to 0.001
  gardner,        ///< kr = Se = exp(alpha psi)
  van_genuchten,  ///< van Genuchten 1980 with Mualem's kr, m = 1 - 1/n
};

/// How flow and soil are computed together.
struct CouplingCase {
  static constexpr double incompressible = std::numeric_limits<double>::infinity();
  double bulk_modulus = 2.2e9;  ///< of water, K_w [Pa]
  double first_step = 0;        ///< of the flow; 0: as short as water takes from particle to particle [s]
  double stabilisation = 0.25;  ///< a of tau = a gamma_w dx^2 / M: see PressureStabilisation [-]
  double growth = 1.3;          ///< largest ratio of a flow step to the one before it [-]
  double tolerance = 0.001;     ///< of the error in time; a tenth of it of force and pressure [-]
};

struct RetentionCase {
  RetentionModel model = RetentionModel::saturated;
  double alpha = 0;  ///< [1/m]
  double n = 0;      ///< of van Genuchten [-]
};

/// What holds at a stretch of the outline.
enum class FaceKind {
  head,     ///< water stands at a level beside it; above that level it is a seepage face
  closed,   ///< nothing passes
  seepage,  ///< water leaves where its pressure reaches that of the air, and none enters
  flux,     ///< so much passes
};

struct HydraulicFaceCase {
  static constexpr double unset = std::numeric_limits<double>::infinity();
  FaceKind kind = FaceKind::closed;
  Eigen::Vector2d from = Eigen::Vector2d::Constant(unset);  ///< straight stretch of the outline [m]
  Eigen::Vector2d to = Eigen::Vector2d::Constant(unset);
  double level = unset;  ///< of kind head: y of the water beside it [m]
  double rate = 0;       ///< of kind flux: into the soil, per area [m/s]

  bool everywhere() const { return from.x() == unset; }  ///< the whole outline
};

}  // namespace porosph
