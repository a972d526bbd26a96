// A case in motion.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/output/frame.hpp"
#include "solver/run/base_motion.hpp"
#include "solver/run/clock.hpp"
#include "solver/run/consolidation.hpp"
#include "solver/run/dynamic_water.hpp"
#include "solver/run/good_states.hpp"
#include "solver/run/hand_over.hpp"
#include "solver/run/monitor/breakdown_watch.hpp"
#include "solver/run/probe.hpp"
#include "solver/run/relaxation.hpp"
#include "solver/run/scaled_inertia.hpp"
#include "solver/run/settling.hpp"
#include "solver/run/surface_forces.hpp"
#include "solver/sph/dynamics.hpp"
#include "solver/water/transient_water.hpp"

namespace porosph {

/// Advances a case step by step. Not copyable; one thread calls it, it uses OpenMP inside.
class Simulation {
 public:
  /// Throws std::runtime_error where the case cannot be built (no particles, boundary touching nothing, ...).
  /// `dynamics`: another implementation than the case's own, to be compared with it.
  explicit Simulation(const Case& scene, const DynamicsMaker& dynamics = make_dynamics);

  /// As above, from another state than the case's own; where `beginning` has none but a time, visit()
  /// restores it.
  Simulation(const Case& scene, const Beginning& beginning, const DynamicsMaker& dynamics = make_dynamics);

  /// The present state, for the next stage or another run to begin with.
  HandedOver hand_over();

  /// Gives a soil another law, before the first step. Throws std::invalid_argument where no soil has that
  /// name, or where the law is stiffer than the soil that sets the time step.
  void set_law(const std::string& soil, AnyLaw law);
  /// Divides the strength that the case gives its soils by `factor`, from the next step on: c and tan(phi),
  /// or c_u, and tension. Whatever the soils remember stays. Not part of the state that visit() saves.
  void reduce_strength(double factor);

  /// Brings soil to rest that follows a flow over time, before the first step; does nothing elsewhere.
  void begin();
  /// One leapfrog step, or one step of the flow where that has its own steps. Does nothing once the run has
  /// become unstable.
  void advance();

  std::int64_t step() const { return clock_.step; }
  std::int64_t last_step() const { return clock_.last_step; }  ///< the step that reaches the case's end time
  double time() const { return clock_.now(); }                 ///< [s]
  double time_of(std::int64_t step) const { return clock_.at(step); }
  double start_time() const { return clock_.start; }           ///< 0, but in later stages [s]
  double time_step() const { return clock_.dt; }               ///< that steps are counted by [s]
  double step_length() const { return clock_.step_length(); }  ///< of the next [s]
  /// Steps so far in which the soil moved with its inertia.
  std::int64_t moves() const { return follows_flow() ? clock_.moves : clock_.step; }
  double courant() const {
    return clock_.courant;
  }  ///< the case's, or less where single particles require it
  const Case& scene() const { return scene_; }
  const Model& model() const { return model_; }
  const std::vector<Probe>& probes() const { return probes_; }
  const std::vector<Footing>& footings() const { return surface_.footings; }
  const std::vector<Sheet>& sheets() const { return surface_.sheets; }
  const Dynamics& dynamics() const { return *dynamics_; }
  const Consolidation* consolidation() const { return flow_.coupled.get(); }  ///< null unless coupled
  const TransientWater* seepage() const { return flow_.seepage.get(); }       ///< null unless transient
  std::int64_t settling_sweeps() const { return flow_.settling.sweeps; }      ///< of the soil in that flow
  /// Whether the soil moves with its inertia and the water in it.
  bool in_motion() const { return motion_.now; }
  /// Null unless excess pore pressure arises in that.
  const DynamicWater* water_in_motion() const { return motion_.acting(); }
  /// Of water that has left coupled soil; nothing elsewhere [m2].
  std::optional<double> drained() const;
  /// Whether time is counted by a flow, whose steps are as long as it allows.
  bool follows_flow() const { return static_cast<bool>(flow_); }
  /// Whether the soil is at rest all the while in that flow: until it fails, where the case continues from
  /// there.
  bool rests_in_flow() const { return follows_flow() && !motion_.now; }
  /// Whether a frame and a row are due now of soil that has failed and moves.
  bool motion_is_due() const;
  double failed_at() const { return motion_.failed_at; }  ///< when it did; never: it has not [s]
  /// energy_counts() when that motion began; null where none began or no excess pressure arises in it.
  const Summary::EnergyBudget* energy_when_lost() const {
    return motion_.energy_when_lost ? &*motion_.energy_when_lost : nullptr;
  }
  /// Energy that loads have put in since then because they change [J/m].
  double given_by_loads() const { return motion_.given_by_loads; }
  const BaseMotion& base() const { return motion_.base; }

  /// Accelerations at the present instant, damping left out [m/s2].
  std::span<const Vec2> accelerations();
  /// Velocities at the present instant (the integrator's are half a step behind) [m/s].
  std::vector<Vec2> velocities();

  double largest_displacement() const;  ///< of all particles, as it counts [m]
  /// Root mean square of the unbalanced forces over that of the weights; infinite in a weightless scene.
  double unbalanced_force_ratio();
  struct Energy {
    double kinetic = 0, elastic = 0, gravity = 0,
           water = 0;  ///< gravity with loads; per metre of thickness [J/m]
    double total() const { return kinetic + elastic + gravity + water; }
  };
  /// Energy at the present instant; gravity and buoyancy relative to the start.
  Energy energy();

  /// What went wrong, where, and what usually causes it; empty while all is well.
  const std::optional<Breakdown>& instability() const { return watch_.found(); }
  /// False where the state is no longer fit to be written: not finite, or faster than its own waves.
  bool showable() const { return !watch_.ran_away(); }
  /// Looks for particles that have met or left the body (costs a neighbour search).
  void look_for_breakdown() { watch_.look(model_, time()); }
  /// Ends the simulation for a reason that the caller found.
  void stop(Breakdown reason) { watch_.stop(std::move(reason)); }

  /// Keeps a copy of the present state as a good one. The last two are kept, as the last may have been good
  /// only in appearance.
  void remember();
  /// Puts the older of the remembered states in the place of the present one, and the present one in its
  /// place; to be looked at only, not to continue from. Returns false where none is remembered.
  bool exchange_with_last_good();

  /// Saves or restores all that changes from step to step. A simulation of the same case that a state was
  /// restored into continues to the same bits. Throws StateError.
  void visit(StateArchive& state);
  double damping() const;  ///< c_d of eq. (34), or that of adaptive relaxation [1/s]
  const ScaledInertia& inertia() const { return to_rest_.inertia; }

 private:
  Kick next_kick() const;
  void drift();
  void couple();
  void time_by_flow();
  bool follow_flow();
  void advance_flow();
  void advance_seepage();
  bool may_lose_equilibrium() const;
  void begin_motion();
  void choose_ticks();
  void count_changing_loads();
  std::int64_t next_due() const;
  std::int64_t motion_tick(double intervals) const;
  void end_after_motion();
  void advance_in_motion();
  void sum_forces();
  void show_excess();
  bool change_pressure();
  void hold_soil(std::span<Vec2> accelerations);
  void settle();
  void take_accelerations_at_rest();
  void visit_motion(StateArchive& state);

  /// What counts time where the soil follows a flow. At most one of the first two is there.
  struct SlowFlow {
    std::unique_ptr<Consolidation> coupled;
    std::shared_ptr<TransientWater> seepage;
    Settling settling;  ///< of the soil in seepage

    explicit operator bool() const { return coupled || seepage; }
    /// One step from `now`, not beyond `until` [s]; returns the time that it reached.
    double advance(double now, double until) {
      return coupled ? coupled->advance(now, until) : seepage->advance(now, until);
    }
  };
  /// Soil that moves with its inertia, and its water with it.
  struct Motion {
    BaseMotion base;
    std::unique_ptr<DynamicWater> water;  ///< null where no excess pressure arises
    bool now = false;
    double failed_at = never;  ///< when soil lost its equilibrium in a flow [s]
    std::optional<Summary::EnergyBudget> energy_when_lost = {};
    double given_by_loads = 0;  ///< since then, as they change [J/m]

    DynamicWater* acting() const { return now ? water.get() : nullptr; }
  };
  /// At the present instant, one per particle [m/s2].
  struct Forces {
    std::vector<Vec2> accelerations;
    std::vector<Vec2> unheld;  ///< without what footings and sheets do; empty where these do nothing
    Kick held_in = {};         ///< the kick for which those hold the soil
    bool valid = false;
  };

  /// Unused unless the case's damping is adaptive.
  struct ToRest {
    Relaxation relaxation;
    ScaledInertia inertia;
  };

  Case scene_;
  Model model_;
  std::unique_ptr<Dynamics> dynamics_;
  SurfaceForces surface_;
  SlowFlow flow_;
  Motion motion_;
  std::vector<Probe> probes_;
  Clock clock_;
  Forces forces_;
  ToRest to_rest_;
  BreakdownWatch watch_;
  GoodStates good_;
};

}  // namespace porosph
