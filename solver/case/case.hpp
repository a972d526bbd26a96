// A scene as its author describes it, after checking: complete, consistent, SI units (m, s, kg, N, Pa).
// Everything that a run depends on is here; `Case` values written as TOML run again to the same result.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "solver/case/flow_case.hpp"
#include "solver/fields/field_table.hpp"

namespace porosph {

using Point = Eigen::Vector2d;       ///< position in the plane, x to the right, y upwards [m]
using Polygon = std::vector<Point>;  ///< closed outline, last point not repeated, either orientation [m]
inline constexpr double never = std::numeric_limits<double>::infinity();

/// How the particles fill the soil's polygons.
enum class Arrangement {
  automatic,  ///< surface on level ground, else stretched: arrangement_for()
  lattice,  ///< square lattice, cell centres inside or on the outline; a soil's particles have equal volumes
  fitted,   ///< square lattice whose cells are clipped by the outline: volumes and centroids fit it
  disordered,  ///< fitted cells of randomly displaced points (for tests of robustness)
  surface,     ///< rows of particles on the free surfaces, with the part of a cell that is soil
  stretched,   ///< cells stretched so that whole rows and columns end at level and upright outlines
};

struct ParticlesCase {
  double spacing = 0;            ///< dx [m]
  double smoothing_ratio = 1.2;  ///< h / dx; in a file by default_smoothing_ratio()
  Arrangement arrangement = Arrangement::lattice;
  double disorder = 0;  ///< largest random displacement / dx, with Arrangement::disordered
  int seed = 1;         ///< of the random displacements
};

/// How a soil's stress follows its strain. All are linear elastic (eqs. 26-30) until they yield.
enum class LawKind {
  elastic,         ///< never yields, optionally without tension
  drucker_prager,  ///< friction and cohesion by a cone with Mohr and Coulomb's strength in plane strain
  mohr_coulomb,    ///< friction and cohesion
  tresca,          ///< undrained clay: a shear strength that does not depend on pressure
  cam_clay,        ///< modified Cam-clay: hardens with compression; elastic by pressure
  byrne,           ///< friction and cohesion; cycles of shear compact it
};
/// Laws with cohesion and a friction angle.
constexpr bool has_friction(LawKind law) {
  return law == LawKind::drucker_prager || law == LawKind::mohr_coulomb || law == LawKind::byrne;
}
enum class SofteningKind { none, exponential, linear };

/// Strength of a soil whose law yields, of use as its law says.
struct StrengthCase {
  double cohesion = 0;              ///< c [Pa]
  double friction_angle = 0;        ///< phi [degrees]
  double dilation_angle = 0;        ///< psi [degrees]
  double dilation_limit = 0.1;      ///< volume strain of plastic flow at which dilation ends [-]
  double tensile_strength = never;  ///< beyond the cone's apex: none other [Pa]
  double undrained_strength = 0;    ///< c_u at `level` and above [Pa]
  double growth = 0;                ///< of c_u with depth below it [Pa/m]
  double level = never;             ///< y; never: the soil's highest point [m]
  SofteningKind softening = SofteningKind::none;
  double softening_strain = 0;   ///< plastic shear strain that takes 1 - 1/e, or all, of what softening takes
  double softening_length = 0;   ///< width of the shear band in which that holds [m]
  double residual_cohesion = 0;  ///< [Pa]
  double residual_friction_angle = 0;  ///< [degrees]
  double sensitivity = 1;              ///< c_u over its residual value
};

/// Of a soil with the law of modified Cam-clay.
struct CamClayCase {
  double ratio = 0;              ///< M, q / p' at the critical state [-]
  double lambda = 0;             ///< slope of the virgin line, 1 + e over ln p' [-]
  double kappa = 0;              ///< slope of the swelling lines [-]
  double void_ratio = 0;         ///< e at the start [-]
  double preconsolidation = 0;   ///< p_c at the start; 0: by overconsolidation [Pa]
  double overconsolidation = 1;  ///< p_c over what the K0 stress at the start needs [-]
  double attraction = 1e3;       ///< what p' and p_c count from, below zero [Pa]
};

/// Of a soil with Byrne's law.
struct CompactionCase {
  double c1 = 0, c2 = 0;  ///< compaction of a cycle is c1 gamma exp(-c2 e / gamma), e what there is of it [-]
  double threshold = 0;   ///< amplitude of shear strain that cycles have to exceed [-]
};

/// One soil: where it is and what it is.
struct SoilCase {
  std::string name;
  Polygon polygon;
  std::vector<Polygon> holes;
  double youngs_modulus = 0;           ///< E [Pa]
  double poissons_ratio = 0;           ///< nu [-]
  double unit_weight_saturated = 0;    ///< gamma_sat [N/m3]
  double unit_weight_unsaturated = 0;  ///< gamma_unsat, above the water level [N/m3]
  bool no_tension = false;  ///< no effective stress where its mean would be tensile; its shear strength is
                            ///< unlimited where the mean is compressive
  Point velocity = Point::Zero();  ///< initial velocity [m/s]
  double angular_velocity = 0;     ///< initial, counter-clockwise about the polygon's middle [rad/s]
  double bending_velocity = 0;     ///< initial, upwards at the tip of a plate clamped at its left end, in the
                                   ///< shape of the first mode [m/s]
  LawKind law = LawKind::elastic;
  StrengthCase strength = {};
  CamClayCase cam_clay = {};
  CompactionCase compaction = {};
  Point permeability = Point::Zero();  ///< k along x and y, saturated; 0 where water does not flow [m/s]
  PermeabilityLaw permeability_law = PermeabilityLaw::constant;
  double porosity = -1;  ///< n; negative: none given, 0.4 [-]
  RetentionCase retention = {};
  int id = -1;  ///< number of the soil in the file, which pieces that stages cut it into share; -1: its place
};

/// Still water. A stretch is level from x_from to x_to; where there is none the soil is dry.
struct WaterStretch {
  double x_from = -never, x_to = never;  ///< [m]
  double level = 0;                      ///< y of the free surface [m]
};
struct WaterCase {
  double unit_weight = 9810;            ///< gamma_w [N/m3]
  std::vector<WaterStretch> stretches;  ///< at t = 0
  std::vector<Point> level_over_time;   ///< (time, level) of a single stretch, linear between [s, m]
  WaterMode mode = WaterMode::still;
  CouplingCase coupling = {};
  std::vector<HydraulicFaceCase> faces =
      {};  ///< of water that flows; of those that overlap the last one holds
  TransientCase transient = {};
  std::vector<DrainCase> drains = {};
  bool present() const { return !stretches.empty(); }  ///< it stands under a level
  bool flows() const { return mode != WaterMode::still; }
  /// Soil and water answer each other.
  bool couples() const { return mode == WaterMode::coupled || mode == WaterMode::undrained; }
  bool flows_over_time() const { return couples() || mode == WaterMode::transient; }
  /// Soil in motion from the start, which gives the time step.
  bool is_dynamic() const { return flows_over_time() && coupling.motion == WaterMotion::dynamic; }
  /// Time is that of the flow, whose steps are as long as their error allows.
  bool steps_by_flow() const { return flows_over_time() && coupling.motion != WaterMotion::dynamic; }
};

enum class BoundaryKind {
  roller,    ///< free to slide along the segment, no motion across it (mirrored ghost particles)
  fixed,     ///< no motion at all (virtual particles)
  friction,  ///< as a roller, but the soil slides along it against friction only
  periodic,  ///< one of two upright sides, behind each of which the soil continues as it begins at the other
};
struct BoundaryCase {
  BoundaryKind kind = BoundaryKind::fixed;
  Point from = Point::Zero(), to = Point::Zero();  ///< straight segment; soil on one side of it [m]
  std::string name = {};                           ///< by which stages call it; may be empty
  double coefficient = 0;  ///< of friction: shear over normal effective stress at most [-]
};

/// Traction on a straight free stretch of the outline as it is at the start: total stress on the soil.
struct LoadCase {
  std::string name;
  Point from = Point::Zero(), to = Point::Zero();  ///< ends of the stretch [m]
  double pressure = 0, pressure_to = 0;            ///< into the soil, at `from` and `to`, linear between [Pa]
  Point traction = Point::Zero(), traction_to = Point::Zero();  ///< further force per area there [Pa]
  std::vector<Point> over_time;  ///< (time, factor of all this), linear between; empty: 1 [s, -]
};

/// A rigid plate on a straight free stretch of the outline. It moves across the stretch without turning, and
/// the soil moves with it; it is driven either by a force or by its settlement.
struct FootingCase {
  std::string name;
  Point from = Point::Zero(), to = Point::Zero();  ///< ends of the stretch [m]
  bool rough = true;             ///< the soil does not move along it; false: it does so freely
  double force = never;          ///< into the soil, per metre of thickness [N/m]; never: not given
  double settlement = never;     ///< into the soil [m]; never: not given
  std::vector<Point> over_time;  ///< (time, factor of this), linear between; empty: 1 [s, -]
};

/// How an end of a sheet is held from where it was placed.
enum class SheetEnd {
  free,
  pinned,  ///< it may turn
  fixed,
};

/// An elastic plate along a level or upright straight line: a sheet pile wall, a geotextile. Soil on one side
/// of it does not see that on the other.
struct SheetCase {
  std::string name;
  Point from = Point::Zero(), to = Point::Zero();  ///< its ends, in the soil as drawn [m]
  double bending_stiffness = 0;                    ///< EI per metre of thickness [N m]
  double axial_stiffness = 0;                      ///< EA per metre of thickness [N/m]
  double mass = 0;                                 ///< per area [kg/m2]
  bool bonded = false;                             ///< soil does not slide along it, nor come off
  double friction = 0;  ///< shear over normal effective stress at most, beside adhesion [-]
  double adhesion = 0;  ///< shear stress that it bears without any normal stress [Pa]
  SheetEnd from_end = SheetEnd::free, to_end = SheetEnd::free;
};

/// The momentum equation's discrete form.
enum class Motion {
  conventional,  ///< eq. (17): pore pressure summed as p_a + p_b
  proposed,      ///< eq. (24): pore pressure as p_b - p_a
  rho_squared,   ///< eq. (25): stress over rho squared
  consistent,    ///< each stress with its own correction matrix: the adjoint of the strain rate
};
struct FormulationCase {
  Motion motion = Motion::consistent;
  bool kernel_correction = true;          ///< eqs. (9), (10)
  double artificial_viscosity_alpha = 0;  ///< linear term of the pairwise artificial viscosity [-]
  double artificial_viscosity_beta = 0;   ///< quadratic term [-]
  double artificial_stress = 0;           ///< epsilon of the artificial stress [-]; 0 is off
  double bulk_viscosity = 0;  ///< b of the viscosity per particle in compression [-]; 0 is off, < 0 automatic
  double zero_energy_control = 0;     ///< viscosity on the non-linear part of the pair velocity / (c_p h) [-]
  double zero_energy_stiffness = -1;  ///< elastic part of that control, in terms of kappa M of the softest
                                      ///< soil in reach [-]; negative: by what is there
                                      ///< (solver/sph/consistent/zero_energy_spring.cpp)
  double refresh_strain = 0;  ///< strain or rotation after which kernel gradients are rebuilt; 0: every step;
                              ///< < 0 automatic [-]
  bool closed_gradients = true;   ///< a uniform stress is in balance also in disorder
  bool single_precision = false;  ///< of stored kernel gradients
};

struct LoadingCase {
  double gravity = 9.81;        ///< g, downwards; also turns unit weight into density [m/s2]
  bool gravity_applied = true;  ///< false: weightless scene (collisions, vibrations)
  bool k0_stress = false;       ///< start from the K0 stress instead of zero stress
  double k0 = -1;      ///< horizontal / vertical effective stress; negative: nu / (1 - nu) of each soil
  double damping = 0;  ///< xi of eq. (34) [-]
  bool adaptive_damping = false;    ///< c_d from the lowest vibration of the motion, in place of xi / dt
  bool scaled_inertia = false;      ///< whether all soils get the softest one's wave speed on the way to rest
  bool scaled_inertia_auto = true;  ///< where that is possible and pays, in place of the above
  double damping_until = never;     ///< time at which the damping ends [s]
  double horizontal = 0;            ///< acceleration to the right over g, beside gravity (pseudo-static) [-]
};

/// Horizontal acceleration of the base and of all other supports: a sine, or any course over time.
struct ShakingCase {
  double amplitude = 0;                       ///< of the sine, to the right first [m/s2]
  double frequency = 0;                       ///< [Hz]
  double cycles = never;                      ///< that it lasts
  double ramp = 0;                            ///< cycles in which it grows, and at its end falls
  double start = 0;                           ///< when it begins [s]
  std::vector<Point> acceleration_over_time;  ///< (time, acceleration) in its place, linear between [s, m/s2]

  bool acts() const { return amplitude != 0 || !acceleration_over_time.empty(); }
};

struct TimeCase {
  double end = 0;        ///< [s]
  double courant = 0.2;  ///< dt = courant * h / c_p, c_p the fastest compression wave [-]
  double step = -1;      ///< dt in place of that, which it must not exceed; negative: none given [s]
};

/// When a run ends before its time.
struct StopCase {
  double unbalanced_force_ratio = 0;  ///< equilibrium when the ratio has fallen below this; 0: never [-]
  bool on_separation = true;          ///< unstable when particles have left the body
  double displacement = never;        ///< the soil has failed when a particle has moved further [m]
};

/// What a run is held against by itself.
struct CheckCase {
  bool finite_elements = false;      ///< whether to compare with finite elements in any case
  bool finite_elements_auto = true;  ///< where they apply and cost little, in place of the above
};

/// The files of the frames.
enum class FrameFormat {
  poly_data,          ///< .vtp
  unstructured_grid,  ///< .vtu
};
enum class Compression { none, lz4, zlib };
enum class FramePrecision { full, single };

struct OutputCase {
  double interval = 0;          ///< between frames; 0: first and last only [s]
  std::vector<double> times;    ///< of further frames [s]
  double history_interval = 0;  ///< between rows of the history; 0: every step [s]
  std::vector<std::string> fields = standard_field_names();
  bool boundary = false;  ///< the images behind the walls as a second block
  FrameFormat format = FrameFormat::poly_data;
  Compression compression = Compression::zlib;
  FramePrecision precision = FramePrecision::full;
};

struct ProbeCase {
  std::string name;
  Point position = Point::Zero();  ///< at t = 0; the probe then moves with the soil [m]
};

/// The exact solution that the run's final state is compared with.
enum class Reference {
  none,
  column,  ///< finite-strain column under its own weight and the water (one soil, level ground, level water)
  conventional_column,  ///< what the conventional form makes of it instead
};

/// How the stress of soil begins that a stage places.
enum class FillStress { none, k0 };

/// What changes from one moment of a run on.
struct StageCase {
  std::string name;
  double duration = 0;                   ///< at most; it ends before where it comes to rest [s]
  std::vector<std::string> excavate;     ///< soils that are removed
  std::vector<Polygon> excavate_within;  ///< outlines within which all soil is removed [m]
  std::vector<std::string> fill;         ///< soils that are placed; absent before
  FillStress fill_stress = FillStress::none;
  std::vector<std::string> load_on, load_off;        ///< loads
  std::vector<std::string> footing_on, footing_off;  ///< footings
  std::vector<std::string> sheet_on, sheet_off;      ///< sheets
  double ramp = 0;  ///< in which loads grow and fall, and footings' forces [s]
  std::vector<std::string> support_on, support_off;  ///< boundaries
  std::vector<std::string> set;                      ///< "key = value", as overrides
  bool reset_displacements = false;                  ///< displacements count from here
  bool safety = false;           ///< at its end the factor of safety of its last state is found
  double safety_bracket = 0.01;  ///< how narrow it is bracketed [-]
};

struct Case {
  std::string title;
  std::string label;  ///< names the run in pictures, comparisons and reports; empty: its folder does
  ParticlesCase particles;
  std::vector<SoilCase> soils;
  WaterCase water;
  std::vector<BoundaryCase> boundaries;
  std::vector<LoadCase> loads;
  std::vector<FootingCase> footings;
  std::vector<SheetCase> sheets = {};
  FormulationCase formulation;
  LoadingCase loading;
  ShakingCase shaking = {};
  TimeCase time;
  StopCase stop;
  CheckCase check;
  OutputCase output;
  std::vector<ProbeCase> probes;
  std::vector<FlowSectionCase> sections = {};  ///< that water is counted at
  Reference reference = Reference::none;
  std::vector<StageCase> stages;  ///< that follow after what stands above has come to its end
  std::string start_from;         ///< folder of another run, whose last state this one begins with; or empty

  /// The case with the soils and boundaries of all stages, of which this one is a stage: particles are placed
  /// as that says. Null where there are no stages. Not part of the file.
  std::shared_ptr<const Case> plan;
  bool all_from_start = true;  ///< no stage has placed soil so far. Not part of the file.

  /// The flow that holds all the time, in place of that of water.mode; null: none. Not part of the file.
  std::shared_ptr<const GivenFlow> flow = {};

  double smoothing_length() const { return particles.smoothing_ratio * particles.spacing; }  ///< h [m]
};

}  // namespace porosph
