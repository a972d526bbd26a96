#include "solver/water/flow/steady_seepage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/space/parallel.hpp"
#include "solver/water/flow/face_switch.hpp"

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
      : flow_(flow), switch_(flow, faces.size(), most_flips) {
    found_.faces = std::move(faces);
    found_.head = std::move(start);
    inflow_.resize(flow.particles());
    change_.resize(flow.particles());
  }

  SteadySeepage solve() {
    for (int i = 0; i < most_switches; ++i) {
      flow_.pin(found_.head, found_.faces);
      newton();
      if (!switch_.update(found_.head, found_.faces)) return std::move(found_);
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

  void newton() {
    double size = assemble(DarcyFlow::Slope::newton);
    bool secant = false;
    for (int i = 0; i < most_newton; ++i) {
      largest_ = std::max(largest_, size);
      found_.left = largest_ > 0 ? size / largest_ : 0;
      if (size <= balanced * largest_) return;
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

  const DarcyFlow& flow_;
  SteadySeepage found_;
  SparseRows slope_;
  std::vector<double> inflow_, change_;
  FaceSwitch switch_;
  double largest_ = 0;  ///< imbalance that was seen [m2/s]
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
