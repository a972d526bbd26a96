#include "solver/sph/consistent/along_interfaces.hpp"

#include <algorithm>

#include "solver/sph/correction/kernel_correction.hpp"

namespace porosph {

/// The weights of all pairs, of the particles at interfaces and of those that they act on.
class AlongInterfaces::Builder {
 public:
  Builder(const ReferenceConfiguration& r, const Model& model, AlongInterfaces& out)
      : r_(r), model_(model), out_(out), count_(static_cast<std::int32_t>(r.particles())) {}

  void build() {
    find_rows();
    out_.particle_ = r_.own_sides.particle;
    for (auto& change : out_.change_) change.assign(out_.particle_.size(), 0);
    for (std::size_t k = 0; k < out_.particle_.size(); ++k) add_pairs(k);
    out_.first_.push_back(out_.pairs_.size());
    place_of_source_.assign(r_.points.size(), -1);
    for (std::int32_t a = 0; a < count_; ++a) add_pulls(a);
    out_.pulled_.push_back({-1, out_.pulls_.size()});
    out_.traction_.resize(out_.sources_.size());
  }

 private:
  /// What the derivative along the interface is made of at one point; no q: it stays that of both sides.
  struct Row {
    Vec2 t = Vec2::Zero(), q = Vec2::Zero();
    bool own = false;
  };

  std::int32_t root(std::int32_t b) const { return b < count_ ? b : r_.ghosts.root(b - count_); }
  std::size_t soil(std::int32_t b) const { return static_cast<std::size_t>(model_.particles.soil[root(b)]); }
  bool in_one_soil(std::int32_t a, std::int32_t b) const {
    const auto& kind = r_.own_sides.kind;
    return kind[soil(a)] == kind[soil(b)];
  }
  bool differ_much(std::int32_t a, std::int32_t b) const {
    const double of_a = model_.soils[soil(a)].constrained_modulus(),
                 of_b = model_.soils[soil(b)].constrained_modulus();
    return std::max(of_a, of_b) >= much_stiffer * std::min(of_a, of_b);
  }
  Vec2 kappa_between(std::int32_t a, std::int32_t b) const {
    return r_.closed() ? Vec2(r_.kappa[b] - r_.kappa[a]) : Vec2(Vec2::Zero());
  }

  void find_rows() {
    constexpr double enough = 0.15;  // of t . (sum_b V_b grad W_ab (x) X_ab) t, which is 1 in one soil
    const OwnSides& sides = r_.own_sides;
    rows_.resize(sides.particle.size());
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const std::int32_t a = sides.particle[k];
      const Vec2 t = sides.tangent(k);
      Mat2 sum = Mat2::Zero();
      Vec2 closed = Vec2::Zero();
      bool beside_another = false;
      r_.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
        beside_another = beside_another || differ_much(a, b);
        if (!in_one_soil(a, b)) return;
        const Vec2 gradient(g.x, g.y);
        sum += gradient * (r_.points[b] - r_.points[a]).transpose();
        closed += gradient * t.dot(kappa_between(a, b));
      });
      if (beside_another && t.dot(sum * t) > enough)
        rows_[k] = {t, correction_matrix(sum) * (t - closed), true};
    }
  }

  /// That of a particle, or of a ghost's root, mirrored.
  Row row_of(std::int32_t b) const {
    const std::int32_t place = r_.own_sides.place[root(b)];
    if (place < 0) return {};
    Row row = rows_[place];
    if (b < count_) return row;
    row.t = r_.ghosts.from_root<Mirrors::direction>(b - count_, row.t);
    row.q = r_.ghosts.from_root<Mirrors::direction>(b - count_, row.q);
    return row;
  }

  /// e of the point with this row, for the pair a, b: seen from either end.
  double weight(const Row& row, std::int32_t point, std::int32_t a, std::int32_t b,
                const PairGeometry& g) const {
    const Vec2 gradient(g.x, g.y);
    const double of_both = row.t.dot(r_.correction[point] * gradient);
    if (in_one_soil(a, b)) return row.q.dot(gradient) - of_both;
    return -of_both - g.w * row.t.dot(kappa_between(a, b));
  }

  void add_pairs(std::size_t k) {
    const std::int32_t a = out_.particle_[k];
    out_.first_.push_back(out_.pairs_.size());
    if (!rows_[k].own) return;
    r_.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      out_.pairs_.push_back({b, weight(rows_[k], a, a, b, g)});
    });
  }

  std::int32_t source(std::int32_t b, const Vec2& along) {
    if (place_of_source_[b] < 0) {
      place_of_source_[b] = static_cast<std::int32_t>(out_.sources_.size());
      out_.sources_.push_back({b, root(b), along});
    }
    return place_of_source_[b];
  }

  /// Force on a: that of its own flux and of its neighbours'.
  void add_pulls(std::int32_t a) {
    const std::size_t first = out_.pulls_.size();
    const Row mine = row_of(a);
    double own = 0;
    r_.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      if (mine.own) own += weight(mine, a, a, b, g);
      if (const Row row = row_of(b); row.own)
        out_.pulls_.push_back({source(b, row.t), weight(row, b, a, b, g)});
    });
    if (mine.own) out_.pulls_.push_back({source(a, mine.t), own});
    if (out_.pulls_.size() > first) out_.pulled_.push_back({a, first});
  }

  const ReferenceConfiguration& r_;
  const Model& model_;
  AlongInterfaces& out_;
  std::int32_t count_;
  std::vector<Row> rows_;                      ///< of each place in OwnSides
  std::vector<std::int32_t> place_of_source_;  ///< of particles and ghosts, or -1
};

AlongInterfaces::AlongInterfaces(const ReferenceConfiguration& r, const Model& model) {
  if (!r.own_sides.empty()) Builder(r, model, *this).build();
  if (!acts()) *this = {};
}

void AlongInterfaces::take_velocities(const std::array<std::vector<double>, 2>& velocity) {
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < particle_.size(); ++k) {
    const std::int32_t a = particle_[k];
    double x = 0, y = 0;
    for (std::size_t m = first_[k]; m < first_[k + 1]; ++m) {
      const auto [b, e] = pairs_[m];
      x += e * (velocity[0][b] - velocity[0][a]), y += e * (velocity[1][b] - velocity[1][a]);
    }
    change_[0][k] = x, change_[1][k] = y;
  }
}

void AlongInterfaces::connect(OwnSideView& view) const {
  for (int d = 0; d < 2; ++d) view.change[d] = acts() ? change_[d].data() : nullptr;
}

void AlongInterfaces::add_forces(const ReferenceConfiguration& r, const PlaneTensors& piola,
                                 std::span<const double> fill, std::span<Vec2> accelerations) {
#pragma omp parallel for schedule(static)
  for (std::size_t s = 0; s < sources_.size(); ++s)
    traction_[s] = fill[sources_[s].root] * (Mat2(piola[sources_[s].point]) * sources_[s].along);
  const std::size_t count = pulled_.empty() ? 0 : pulled_.size() - 1;
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < count; ++k) {
    Vec2 force = Vec2::Zero();
    for (std::size_t m = pulled_[k].first; m < pulled_[k + 1].first; ++m)
      force += pulls_[m].weight * traction_[pulls_[m].of];
    const std::int32_t a = pulled_[k].particle;
    accelerations[a] += force / (fill[a] * r.density[a]);
  }
}

}  // namespace porosph
