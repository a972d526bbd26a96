// What a case says of water that flows: soils' permeability and retention, and the faces through which it
// enters and leaves.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace porosph {

/// What the pore water does.
enum class WaterMode {
  still,      ///< it stands under its level: hydrostatic
  steady,     ///< steady seepage between the faces; the soil then carries that flow
  coupled,    ///< saturated soil gives its water away over time: consolidation
  undrained,  ///< saturated soil keeps its water
  transient   ///< seepage over time in soil that is saturated in part; the soil follows at rest
};

/// As in the case file.
constexpr std::string_view name(WaterMode mode) {
  constexpr std::string_view names[] = {"still", "steady", "coupled", "undrained", "transient"};
  return names[static_cast<int>(mode)];
}

/// How soil moves that water flows in over time.
enum class WaterMotion {
  quasi_static,  ///< at rest all the while; a run in which it does not come to rest ends
  dynamic,       ///< with its inertia
  automatic      ///< at rest until it does not come to rest any more, and with its inertia from there on
};

/// What permeability does as the soil deforms.
enum class PermeabilityLaw {
  constant,
  kozeny_carman,  ///< k ~ n^3 / (1 - n)^2 from its value at the start
};

/// How permeability and saturation fall above the water table.
enum class RetentionModel {
  saturated,      ///< full below the water table; within one spacing above it kr falls to 0.001
  gardner,        ///< kr = Se = exp(alpha psi)
  van_genuchten,  ///< van Genuchten 1980 with Mualem's kr, m = 1 - 1/n
  table,          ///< Se and kr over suction, linear between
};

/// How flow and soil are computed together.
struct CouplingCase {
  static constexpr double incompressible = std::numeric_limits<double>::infinity();
  WaterMotion motion = WaterMotion::quasi_static;
  double motion_time = 20;       ///< automatic: of the run after equilibrium is lost [s]
  double motion_interval = 0.5;  ///< between frames and rows of the history in it [s]
  double bulk_modulus = 2.2e9;   ///< of water, K_w [Pa]
  double first_step = 0;         ///< of the flow; 0: as short as water takes from particle to particle [s]
  double stabilisation = 0.25;   ///< a of tau = a gamma_w dx^2 / M: see PressureStabilisation [-]
  double growth = 1.3;           ///< largest ratio of a flow step to the one before it [-]
  double tolerance = 0.001;      ///< of the error in time; a tenth of it of force and pressure [-]
};

struct RetentionCase {
  RetentionModel model = RetentionModel::saturated;
  double alpha = 0;     ///< [1/m]
  double n = 0;         ///< of van Genuchten [-]
  double residual = 0;  ///< water that stays, over the soil's volume [-]
  std::vector<Eigen::Vector2d> saturation = {}, permeability = {};  ///< (suction, Se), (suction, kr) [m, -]
};

/// How seepage over time begins and what the soil does in it.
struct TransientCase {
  static constexpr double unset = std::numeric_limits<double>::infinity();
  double start_level = unset;          ///< of water at rest, y [m]; unset: steady flow at t = 0
  double start_pressure_head = unset;  ///< psi at the start, or the least of it above start_level [m]
  bool rigid = false;                  ///< the soil does not move
};

/// What holds at a stretch of the outline.
enum class FaceKind {
  head,     ///< water stands at a level beside it; above that level it is a seepage face
  closed,   ///< nothing passes
  seepage,  ///< water leaves where its pressure reaches that of the air, and none enters
  flux,     ///< so much passes
  rain,     ///< rain or evaporation, as much as the soil takes or gives
};

struct HydraulicFaceCase {
  static constexpr double unset = std::numeric_limits<double>::infinity();
  FaceKind kind = FaceKind::closed;
  Eigen::Vector2d from = Eigen::Vector2d::Constant(unset);  ///< straight stretch of the outline [m]
  Eigen::Vector2d to = Eigen::Vector2d::Constant(unset);
  double level = unset;   ///< of kind head: y of the water beside it [m]
  double rate = 0;        ///< into the soil: of kind flux per area, of kind rain per area of its plan [m/s]
  std::string name = {};  ///< in the history; may be empty
  std::vector<Eigen::Vector2d> level_over_time = {};  ///< (time, level), in place of level [s, m]
  std::vector<Eigen::Vector2d> rate_over_time = {};   ///< (time, rate), in place of rate [s, m/s]
  double ponding = 0;                                 ///< psi at which rain runs off [m]
  double driest = -1000;                              ///< psi at which evaporation falls [m]

  bool changes() const { return !level_over_time.empty() || !rate_over_time.empty(); }
  bool everywhere() const { return from.x() == unset; }  ///< the whole outline
};

/// A flow at one instant, which holds all the time.
struct GivenFlow {
  std::vector<double> head;  ///< of the particles, relative to the model's origin [m]
  double time = 0;           ///< at which faces are as they are then [s]
};

/// A drain or well in the soil: a straight line, or a point.
struct DrainCase {
  std::string name;
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();  ///< ends [m]
  double level = HydraulicFaceCase::unset;  ///< of the water in it; unset: open to the air [m]
  double radius = 0;                        ///< of one at a point [m]; 0: its particle's own

  /// What the particle at a point draws like, over the spacing (docs/seepage.md, "Wells").
  static constexpr double own_radius = 0.163;
};

/// A line whose discharge is reported.
struct FlowSectionCase {
  std::string name;
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();  ///< ends [m]
};

}  // namespace porosph
