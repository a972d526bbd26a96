// What leaves the solver: the particle data of one instant, and the story of a whole run.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "solver/output/fem_check.hpp"

namespace porosph {

/// One array of particle data, SI units, particle-major: value c of particle i is values[i * width + c].
struct FrameField {
  std::string name;                     ///< CamelCase, as in the files
  std::vector<std::string> components;  ///< names of the components; empty for a scalar
  std::variant<std::vector<double>, std::vector<std::int32_t>> values;
  int width() const { return components.empty() ? 1 : static_cast<int>(components.size()); }
};

/// Particle data at one instant. Only real particles, never ghosts.
struct Frame {
  std::int64_t step = 0;
  double time = 0;             ///< [s]
  std::vector<double> points;  ///< 3 per particle, z = 0 in plane strain [m]
  std::vector<FrameField> fields;
};

/// A sheet at one instant, node by node.
struct SheetFrame {
  struct Node {
    double x = 0, y = 0;                      ///< where it was placed [m]
    double u_x = 0, u_y = 0;                  ///< its displacement since then [m]
    double axial = 0, shear = 0, moment = 0;  ///< per metre of thickness [N/m, N/m, N]
  };
  std::string name;
  std::vector<Node> nodes;
};

/// Probe readings over time: one row per recorded instant.
struct History {
  std::vector<std::string> columns;  ///< "time", then "<probe>.<quantity>", SI units
  std::vector<std::vector<double>> rows;
};

enum class RunStatus { completed, equilibrium, unstable, interrupted };

struct ErrorNorms {
  double relative_l2 = 0;  ///< ||computed - reference|| / ||reference||, volume-weighted [-]
  double max_abs = 0;      ///< largest |computed - reference|, in the field's unit
};

/// The story of a run, as summary.json tells it.
struct Summary {
  RunStatus status = RunStatus::completed;
  std::string message;  ///< where and why, if it did not simply complete
  std::string title, formulation;
  bool kernel_correction = true;
  std::int64_t particles = 0, steps = 0;
  double time = 0, time_step = 0;  ///< [s]
  double courant = 0;              ///< that was used, at most the case's; 0: not told [-]
  int threads = 1;
  double wall_seconds = 0, stepping_seconds = 0, particle_steps_per_second = 0;
  std::int64_t peak_memory_bytes = 0;
  /// Soil -> inertia over mass, of the soils whose inertia was scaled.
  std::map<std::string, double> scaled_inertia;
  double unbalanced_force_ratio = 0;
  double energy_growth =
      0;  ///< total energy gained since the start over what moves and strains at the end [-]
  /// Displacements that alternate from particle to particle: see run/monitor/zigzag.hpp.
  struct Zigzag {
    double rms = 0, quantile = 0;  ///< over the difference of neighbours [-]
    double largest = 0;            ///< [m]
    double x = 0, y = 0;           ///< where that is [m]
  };
  std::optional<Zigzag> zigzag;
  /// Where the energy went that gravity released in soil that flows [J/m].
  struct EnergyBudget {
    double released = 0;        ///< by gravity, loads, water, shaking and evening out the particles
    double kinetic = 0;         ///< now
    double elastic = 0;         ///< gained
    double plastic = 0;         ///< dissipated by the soil laws
    double control = 0;         ///< by the zero-energy control
    double contact = 0;         ///< by walls that stop loose particles
    double friction = 0;        ///< by friction on walls
    double walls = 0;           ///< by the stress that is extrapolated behind walls
    double diffusion = 0;       ///< by the diffusion of stress
    double bulk_viscosity = 0;  ///< by bulk viscosity
    double water = 0;        ///< taken by pore water that moves with the soil: stored, and dissipated in it
    double unaccounted = 0;  ///< the rest: what the integration loses or gains
  };
  std::optional<EnergyBudget> energy;
  /// What water did that flows.
  struct Seepage {
    std::vector<double> through_faces;  ///< into the soil through each [[water.face]] of the case [m2/s]
    double imbalance = 0;               ///< what enters less what leaves, over what enters [-]
    int newton_steps = 0, krylov_iterations = 0;
    std::map<std::string, double> sections = {};  ///< through each, from its left to its right [m2/s]
  };
  std::optional<Seepage> seepage;
  /// What seepage over time took, and its balance of water.
  struct TransientSeepage {
    std::int64_t flow_steps = 0, refused_steps = 0, newton_steps = 0, krylov_iterations = 0, soil_sweeps = 0;
    double entered = 0, left = 0;  ///< through faces and drains since the start [m2]
    double gained = 0;             ///< by the soil [m2]
    double imbalance = 0;          ///< gained less entered, plus left, over what moved [-]
  };
  std::optional<TransientSeepage> transient;
  /// What a coupled run took, and the water that the soil gave away.
  struct Consolidation {
    std::int64_t flow_steps = 0, pressure_solves = 0, krylov_iterations = 0, soil_sweeps = 0;
    double drained = 0;    ///< [m2]
    double imbalance = 0;  ///< lost by the particles and not drained [m2]
  };
  std::optional<Consolidation> consolidation;
  /// Soil whose pore pressure moved with its inertia.
  struct WaterMotion {
    double began = 0;  ///< when equilibrium was lost; 0: at the start [s]
    std::int64_t steps = 0, krylov_iterations = 0, renewals = 0;
    double drained = 0;    ///< since the start of the run [m2]
    double imbalance = 0;  ///< lost by the particles and not drained [m2]
    double misfit = 0;     ///< largest, of a particle's volume and water, over its volume [-]
  };
  std::optional<WaterMotion> motion;
  struct Probe {
    double x = 0, y = 0;                   ///< where it was at t = 0 [m]
    std::map<std::string, double> values;  ///< quantity -> final value, SI
  };
  std::map<std::string, Probe> probes;
  std::map<std::string, ErrorNorms>
      errors;  ///< field (EffectiveStress_YY) -> norms, where the case names a reference
  /// What holds a rigid footing, per metre of thickness.
  struct Footing {
    double force = 0, shear = 0;  ///< against it, and along it [N/m]
    double settlement = 0;        ///< into the soil, since it was placed [m]
    double width = 0;             ///< of the soil's surface that moves with it [m]
  };
  std::map<std::string, Footing> footings;  ///< at the end
  /// The largest of what a sheet carries, with its sign, per metre of thickness.
  struct Sheet {
    double moment = 0;            ///< [N]
    double shear = 0, axial = 0;  ///< [N/m]
    double displacement = 0;      ///< [m]
  };
  std::map<std::string, Sheet> sheets;  ///< at the end
  /// A factor of safety.
  struct Safety {
    double stable_at = 0;          ///< largest with which the soil rests; 0: none was found
    double fails_at = 0;           ///< smallest at which it fails; infinite: none was found
    double limit_equilibrium = 0;  ///< least of all slip surfaces; 0: none
    std::string note;              ///< why there is no answer, or what is doubtful about it
  };
  /// One stage of a case that has them.
  struct Stage {
    std::string name;
    std::string ended;                             ///< "time", "rest", "failure", "unstable" or "interrupted"
    double start = 0, time = 0;                    ///< when it began and ended [s]
    std::int64_t steps = 0, particles = 0;         ///< of this stage
    double unbalanced_force_ratio = 0;             ///< at its end [-]
    double largest_displacement = 0;               ///< at its end, as displacements count [m]
    std::map<std::string, Probe> probes = {};      ///< at its end
    std::map<std::string, Footing> footings = {};  ///< at its end
    std::map<std::string, Sheet> sheets = {};      ///< at its end
    std::optional<Safety> safety = {};             ///< of its last state, where the stage asks for it
  };
  std::vector<Stage> stages;                   ///< that have been computed; empty where the case has none
  std::optional<FemCheck> finite_elements;     ///< what the run is held against by itself
  std::vector<std::string> warnings;           ///< of how it began and what it came to
  std::map<std::string, std::string> skipped;  ///< what the scene did not need -> why
};

}  // namespace porosph
