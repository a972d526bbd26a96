#include "solver/water/flow/steady_seepage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/space/parallel.hpp"

namespace porosph {
namespace {

constexpr double balanced = 1e-10;  // what may remain, of what flows
constexpr int most_newton = 200, most_switches = 100, most_flips = 4;
constexpr double krylov_tolerance = 1e-4;  // of a Newton step's residual

double norm(const std::vector<double>& x) {
  return std::sqrt(deterministic_sum(x.size(), [&](std::size_t i) { return x[i] * x[i]; }));
}

class Steady {
 public:
  Steady(const DarcyFlow& flow, FaceConditions faces, std::vector<double> start)
      : flow_(flow), flips_(faces.size(), 0) {
    found_.faces = std::move(faces);
    found_.head = std::move(start);
    inflow_.resize(flow.particles());
    change_.resize(flow.particles());
  }

  SteadySeepage solve() {
    for (int i = 0; i < most_switches; ++i) {
      flow_.pin(found_.head, found_.faces);
      newton();
      if (!switch_faces()) return std::move(found_);
    }
    throw std::runtime_error(
        fmt::format("steady seepage: seepage faces still open and close after {} rounds; a finer spacing, or "
                    "retention that changes less within one, helps",
                    most_switches));
  }

 private:
  double assemble(DarcyFlow::Slope kind) {
    flow_.assemble(found_.head, found_.faces, kind, slope_, inflow_);
    return norm(inflow_);
  }

  /// All flows between particles, as a measure of what rounding can leave.
  double scale() const {
    double largest = 0;
    const auto [low, high] = std::ranges::minmax(found_.head);
    for (const double d : slope_.diagonal) largest = std::max(largest, d);
    return largest * std::max(high - low, 1e-12 * std::abs(high));
  }

  void newton() {
    double size = assemble(DarcyFlow::Slope::newton);
    bool secant = false;
    for (int i = 0; i < most_newton; ++i) {
      found_.left = size / scale();
      if (!(scale() > 0) || size <= balanced * scale()) return;
      if (secant) assemble(DarcyFlow::Slope::secant);
      std::ranges::fill(change_, 0.0);
      const int most = static_cast<int>(20 * std::sqrt(static_cast<double>(flow_.particles())) + 1000);
      const KrylovResult solved = secant
                                      ? conjugate_gradients(slope_, inflow_, change_, krylov_tolerance, most)
                                      : bicgstab(slope_, inflow_, change_, krylov_tolerance, most);
      ++found_.newton_steps, found_.krylov_iterations += solved.iterations;
      const double next = step_along(size, secant);
      secant = !secant && !(next < 0.9 * size);
      size = next;
    }
    throw std::runtime_error(
        fmt::format("steady seepage does not converge: {:.2g} of the flow is not in balance after {} Newton "
                    "steps; the usual cause is retention that changes much within one spacing",
                    found_.left, most_newton));
  }

  /// Takes as much of the change as lessens the imbalance; a secant step is taken whole.
  double step_along(double size, bool secant) {
    const std::vector<double> before = found_.head;
    double share = 1, next = size;
    for (int halvings = 0; halvings < 6; ++halvings, share /= 2) {
      for (std::size_t a = 0; a < before.size(); ++a) found_.head[a] = before[a] + share * change_[a];
      next = assemble(DarcyFlow::Slope::newton);
      if (secant || next < size) break;
    }
    return next;
  }

  /// Returns whether any changed. One that goes on changing stays closed: it is where the water table meets
  /// the face, to within a patch.
  bool switch_faces() {
    const std::vector<double> through = flow_.through_patches(found_.head, found_.faces);
    const std::vector<double> pressure = flow_.pressure_heads_at_patches(found_.head);
    const double tiny =
        1e-9 * deterministic_sum(through.size(), [&](std::size_t p) { return std::abs(through[p]); });
    bool changed = false;
    for (std::size_t p = 0; p < through.size(); ++p) {
      const auto patch = static_cast<std::int32_t>(p);
      if (flips_[p] >= most_flips || !found_.faces.seeps(patch)) continue;
      const bool open = found_.faces.open(patch);
      if (open ? !(through[p] > tiny) : !(pressure[p] > 0)) continue;
      found_.faces.set_open(patch, !open);
      ++flips_[p], changed = true;
    }
    return changed;
  }

  const DarcyFlow& flow_;
  SteadySeepage found_;
  SparseRows slope_;
  std::vector<double> inflow_, change_;
  std::vector<int> flips_;
};

}  // namespace

SteadySeepage solve_steady(const DarcyFlow& flow, FaceConditions faces, std::vector<double> start) {
  return Steady(flow, std::move(faces), std::move(start)).solve();
}

std::vector<double> start_of_steady(const std::vector<HydraulicFaceCase>& faces,
                                    std::span<const double> height) {
  double level = -never;
  for (const HydraulicFaceCase& face : faces)
    if (face.kind == FaceKind::head) level = std::max(level, face.level);
  if (level == -never) level = height.empty() ? 0 : *std::ranges::max_element(height);
  return std::vector<double>(height.size(), level);
}

std::vector<double> through_faces(const DarcyFlow& flow, const HydraulicOutline& outline,
                                  std::span<const double> head, const FaceConditions& conditions,
                                  std::size_t faces) {
  const std::vector<double> through = flow.through_patches(head, conditions);
  std::vector<double> of_face(faces, 0);
  for (std::size_t p = 0; p < through.size(); ++p)
    if (outline.patches[p].face >= 0) of_face[outline.patches[p].face] += through[p];
  return of_face;
}

}  // namespace porosph
