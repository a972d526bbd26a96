#include "solver/water/flow/section_flow.hpp"

#include "solver/space/parallel.hpp"

namespace porosph {
namespace {

double side(const FlowSectionCase& s, const Vec2& p) {  // positive on the left
  const Vec2 way = s.to - s.from, there = p - s.from;
  return way.x() * there.y() - way.y() * there.x();
}

/// Whether the line from a, on the left, to b passes the section. What lies on it counts as on its left.
bool passes(const FlowSectionCase& s, const Vec2& a, const Vec2& b) {
  const double of_a = side(s, a), of_b = side(s, b);
  if (of_a < 0 || of_b >= 0) return false;
  const Vec2 at = a + of_a / (of_a - of_b) * (b - a), way = s.to - s.from;
  const double along = way.dot(at - s.from) / way.squaredNorm();
  return along >= 0 && along <= 1;
}

}  // namespace

SectionFlow::SectionFlow(const FlowSectionCase& section, const DarcyFlow& flow,
                         std::span<const Vec2> position) {
  const FlowPairs& all = flow.pairs();
  for (std::size_t a = 0; a < position.size(); ++a)
    for (auto k = all.begin[a]; k < all.begin[a + 1]; ++k) {
      const FlowPair& p = all.pairs[k];
      if (passes(section, position[a], position[p.to]))
        pairs_.push_back({static_cast<std::int32_t>(a), p.to, p.conductance, -1});
    }
  for (std::size_t k = 0; k < all.face_pairs.size(); ++k) {
    const FacePair& p = all.face_pairs[k];
    if (passes(section, position[p.from], position[p.to]))
      pairs_.push_back({p.from, p.to, p.conductance, static_cast<std::int64_t>(k)});
  }
}

double SectionFlow::discharge(const DarcyFlow& flow, std::span<const double> head,
                              const FaceConditions& faces) const {
  return deterministic_sum(pairs_.size(), [&](std::size_t i) {
    const Pair& p = pairs_[i];
    if (p.face_pair >= 0 && flow.has_head(flow.pairs().face_pairs[p.face_pair], faces)) return 0.0;
    return flow.between(p.right, p.left, p.conductance, head);
  });
}

}  // namespace porosph
