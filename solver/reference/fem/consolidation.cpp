#include "solver/reference/fem/consolidation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "solver/reference/fem/biot_equations.hpp"

namespace porosph {
namespace {

constexpr double steps_in_doubling = 8;
constexpr double first_part = 1.0 / 2048;  // of the time to the first state that is asked for: its first step

/// Alexander's coefficients: gamma^3 - 3 gamma^2 + 3/2 gamma - 1/6 = 0.
constexpr double gamma_of_sdirk = 0.43586652150845899942;
constexpr double first_weight = -(6 * gamma_of_sdirk * gamma_of_sdirk - 16 * gamma_of_sdirk + 1) / 4;
constexpr double second_weight = (6 * gamma_of_sdirk * gamma_of_sdirk - 20 * gamma_of_sdirk + 5) / 4;

class Consolidating {
 public:
  Consolidating(const Case& scene, const Mesh& mesh)
      : scene_(scene),
        mesh_(mesh),
        nodes_(place_nodes(mesh)),
        standing_{water_of_triangles(scene.water, mesh), {}, {}},
        freedoms_(constrain(scene, mesh, nodes_)),
        skeleton_(assemble(scene, mesh, nodes_, standing_, freedoms_)),
        equations_(skeleton_.stiffness, assemble_pore_flow(scene, mesh, nodes_, freedoms_),
                   scene.water.unit_weight),
        water_(Eigen::VectorXd::Zero(equations_.flow().inflow.size())) {}

  /// Under the loads of a time, where no water has moved.
  void load_at_once(double time) {
    equations_.set(0);
    equations_.solve(load(time), Eigen::VectorXd::Zero(water_.size()), displacement_, head_);
  }

  void step(double now, double dt) {
    constexpr double g = gamma_of_sdirk;
    equations_.set(g * dt);
    const Eigen::VectorXd start = water_;
    const Eigen::VectorXd first = stage(now + g * dt, start, g * dt);
    const Eigen::VectorXd second = stage(now + (1 + g) / 2 * dt, start + (1 - g) / 2 * dt * first, g * dt);
    const Eigen::VectorXd known = start + dt * (first_weight * first + second_weight * second);
    water_ = known + g * dt * stage(now + dt, known, g * dt);
  }

  FemSolution state() const {
    FemSolution solution(scene_, mesh_, nodes_, pore_water(), displacements(freedoms_, displacement_));
    solution.unknowns = freedoms_.unknowns + static_cast<int>(water_.size());
    return solution;
  }

 private:
  Eigen::VectorXd load(double time) const {
    return skeleton_.load + surface_load(scene_, mesh_, nodes_, freedoms_, time);
  }

  /// Solves C^T u + (S + tau H) h = known + tau q with the balance of forces; returns q - H h.
  Eigen::VectorXd stage(double time, const Eigen::VectorXd& known, double tau) {
    const PoreFlow& flow = equations_.flow();
    equations_.solve(load(time), known + tau * flow.inflow, displacement_, head_);
    return flow.inflow - flow.conductivity * head_;
  }

  /// p_w of the level and the excess head, at all nodes.
  MeshWater pore_water() const {
    const PoreFlow& flow = equations_.flow();
    MeshWater water{{}, std::vector<double>(nodes_.nodes.size()), std::vector<double>(nodes_.nodes.size())};
    const double level = scene_.water.stretches.front().level;
    for (std::size_t t = 0; t < nodes_.triangles.size(); ++t)
      for (int i = 0; i < p4::node_count; ++i) {
        const int n = nodes_.triangles[t][i];
        const p2::Values shape = p2::values(p4::nodes()[i]);
        double psi = level - nodes_.nodes[n].y();
        for (int k = 0; k < p2::node_count; ++k) psi += shape[k] * head_[flow.triangles[t][k]];
        water.pressure_head[n] = psi, water.pore_pressure[n] = -scene_.water.unit_weight * psi;
      }
    return water;
  }

  const Case& scene_;
  const Mesh& mesh_;
  P4Mesh nodes_;
  MeshWater standing_;
  Freedoms freedoms_;
  LinearSystem skeleton_;
  BiotEquations equations_;
  Eigen::VectorXd water_;  ///< that the parts of the soil have gained [m2]
  Eigen::VectorXd displacement_, head_;
};

/// Where the loads' courses bend, before `end`.
std::vector<double> bends(const Case& scene, double end) {
  std::vector<double> times;
  const auto add = [&](const std::vector<Point>& over_time) {
    for (const Point& p : over_time)
      if (p.x() > 0 && p.x() < end) times.push_back(p.x());
  };
  for (const LoadCase& load : scene.loads) add(load.over_time);
  for (const FootingCase& footing : scene.footings) add(footing.over_time);
  return times;
}

/// Steps as long as the time since a bend allows, which end on `until`.
void advance(Consolidating& soil, double now, double until, double bend, double first_step) {
  while (now < until) {
    const double doublings = std::floor(std::log2((now - bend) / (steps_in_doubling * first_step) + 1e-9));
    const double longest = first_step * std::exp2(std::max(0.0, doublings));
    const double steps = std::max(1.0, std::ceil((until - now) / longest - 1e-9));
    const double dt = (until - now) / steps;
    soil.step(now, dt);
    now = steps == 1 ? until : now + dt;
  }
}

}  // namespace

void consolidate_by_fem(const Case& scene, const Mesh& mesh, const std::vector<double>& times,
                        const std::function<void(double time, const FemSolution&)>& use) {
  const auto start = std::chrono::steady_clock::now();
  if (scene.loading.k0_stress)
    throw std::runtime_error(
        "finite elements: loading.k0_stress = true is not supported; the reference starts from an unstressed "
        "soil");
  for (const SoilCase& soil : scene.soils)
    if (soil.permeability_law != PermeabilityLaw::constant)
      throw std::runtime_error(
          fmt::format("finite elements: the permeability of soil '{}' follows its pores, which is not linear",
                      soil.name));
  check_mesh(mesh, static_cast<int>(scene.soils.size()));
  Consolidating soil(scene, mesh);
  const auto tell = [&](double time) {
    FemSolution state = soil.state();
    state.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    use(time, state);
  };
  const std::vector<double> bent = times.empty() ? std::vector<double>{} : bends(scene, times.back());
  std::vector<double> stops = times;
  stops.insert(stops.end(), bent.begin(), bent.end());
  std::ranges::sort(stops);
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
  double now = 0, bend = 0, first_step = 0;
  for (const double stop : stops) {
    if (stop == 0 || scene.water.mode == WaterMode::undrained) {
      soil.load_at_once(stop);
    } else {
      if (now == bend) first_step = first_part * (stop - now);
      advance(soil, now, stop, bend, first_step);
      now = stop;
    }
    if (std::ranges::find(bent, stop) != bent.end()) bend = stop;
    if (std::ranges::find(times, stop) != times.end()) tell(stop);
  }
}

}  // namespace porosph
