#include "solver/water/flow/pressure_stabilisation.hpp"

#include <algorithm>

namespace porosph {

PressureStabilisation::PressureStabilisation(const DarcyFlow& closed, const HydraulicOutline& outline,
                                             std::span<const Vec2> position)
    : pairs_(closed.pairs()) {
  const std::vector<double> level(pairs_.particles(), 0);
  std::vector<double> none(pairs_.particles());
  const FaceConditions faces(outline, {{.kind = FaceKind::closed}}, true);
  closed.assemble(level, faces, DarcyFlow::Slope::secant, compact_, none);
  for (std::size_t a = 0; a < pairs_.particles(); ++a)
    for (auto k = pairs_.begin[a]; k < pairs_.begin[a + 1]; ++k)
      x_.push_back(position[pairs_.pairs[k].to] - position[a]);
  for (std::size_t a = 0; a < pairs_.particles(); ++a) {
    Mat2 second = Mat2::Zero();
    for_pairs(a, [&](std::int32_t, double c, const Vec2& x) { second += c * x * x.transpose(); });
    const double size = second.trace();
    const bool spans = second.determinant() > 1e-3 * size * size;
    second_.push_back(spans ? inverse(second) : Mat2(Mat2::Zero()));
  }
}

/// Calls use(b, c_ab, x_ab) for its pairs, with images as the particles that they mirror.
template <class Use>
void PressureStabilisation::for_pairs(std::size_t a, Use&& use) const {
  for (auto k = pairs_.begin[a]; k < pairs_.begin[a + 1]; ++k)
    use(pairs_.pairs[k].to, pairs_.pairs[k].conductance, x_[k]);
  for (auto k = pairs_.face_begin[a]; k < pairs_.face_begin[a + 1]; ++k) {
    const FacePair& pair = pairs_.face_pairs[k];
    use(pair.to, pair.conductance, pair.x);
  }
}

void PressureStabilisation::apply(std::span<const double> head, std::span<double> out) const {
  compact_.multiply(head, out);
  std::vector<Vec2> mean(pairs_.particles());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < mean.size(); ++a) {
    Vec2 q = Vec2::Zero();
    for_pairs(a, [&](std::int32_t b, double c, const Vec2& x) { q += c * (head[b] - head[a]) * x; });
    mean[a] = second_[a] * q / 2;
  }
  for (std::size_t a = 0; a < mean.size(); ++a)
    for_pairs(a, [&](std::int32_t b, double c, const Vec2& x) {
      const double t = c * x.dot(mean[a]);
      out[b] -= t, out[a] += t;
    });
}

}  // namespace porosph
