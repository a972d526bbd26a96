#include "solver/water/flow/pressure_stabilisation.hpp"

#include <algorithm>

namespace porosph {
namespace {

constexpr double rounding = 1e-9;

}  // namespace

/// A particle in half a cell on the outline is its own image: what its neighbour passes to it beyond what it
/// passes to the neighbour goes to that image.
PressureStabilisation::PressureStabilisation(const DarcyFlow& closed, const HydraulicOutline& outline,
                                             std::span<const Vec2> position) {
  const FlowPairs& flow = closed.pairs();
  const std::size_t n = flow.particles();
  const std::vector<double> level(n, 0);
  std::vector<double> none(n);
  const FaceConditions faces(outline, {{.kind = FaceKind::closed}}, true);
  closed.assemble(level, faces, DarcyFlow::Slope::secant, compact_, none);
  for (std::size_t a = 0; a < n; ++a) {
    pairs_.begin.push_back(std::ssize(pairs_.to)), images_.begin.push_back(std::ssize(images_.to));
    Mat2 second = Mat2::Zero();
    const auto add = [&](Links& links, std::int32_t b, double c, const Vec2& x) {
      links.to.push_back(b), links.flow.emplace_back(c * x);
      second += c * x * x.transpose();
    };
    for (auto k = flow.begin[a]; k < flow.begin[a + 1]; ++k) {
      const auto& [b, c] = flow.pairs[k];
      const double both = std::min(c, flow.conductance(b, static_cast<std::int32_t>(a)));
      add(pairs_, b, both, position[b] - position[a]);
      if (c - both > rounding * c) add(images_, b, c - both, position[b] - position[a]);
    }
    for (auto k = flow.face_begin[a]; k < flow.face_begin[a + 1]; ++k) {
      const FacePair& pair = flow.face_pairs[k];
      add(images_, pair.to, pair.conductance, pair.x);
    }
    const double size = second.trace();
    const bool spans = second.determinant() > 1e-3 * size * size;
    second_.push_back(spans ? Mat2(inverse(second) / 2) : Mat2(Mat2::Zero()));
  }
  pairs_.begin.push_back(std::ssize(pairs_.to)), images_.begin.push_back(std::ssize(images_.to));
}

/// A pair is listed by both of its particles, an image by the one that sees it.
void PressureStabilisation::apply(std::span<const double> head, std::span<double> out) const {
  compact_.multiply(head, out);
  const std::size_t n = second_.size();
  std::vector<Vec2> mean(n);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) {
    Vec2 q = Vec2::Zero();
    const auto add = [&](std::int32_t b, const Vec2& flow) { q += (head[b] - head[a]) * flow; };
    pairs_.of(a, add), images_.of(a, add);
    mean[a] = second_[a] * q;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) {
    double sum = 0;
    pairs_.of(a, [&](std::int32_t b, const Vec2& flow) { sum += flow.dot(mean[a] + mean[b]); });
    images_.of(a, [&](std::int32_t, const Vec2& flow) { sum += flow.dot(mean[a]); });
    out[a] += sum;
  }
  for (std::size_t a = 0; a < n; ++a)
    images_.of(a, [&](std::int32_t b, const Vec2& flow) { out[b] -= flow.dot(mean[a]); });
}

}  // namespace porosph
