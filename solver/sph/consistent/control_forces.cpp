#include "solver/sph/consistent/control_forces.hpp"

namespace porosph {

void control_forces(const ReferenceConfiguration& r, const Particles& p, const RowsAtWalls& rows,
                    std::span<const double> viscosity, std::span<Vec2> out) {
  const auto n = static_cast<std::int32_t>(r.particles());
  std::vector<Mat2> gradient(n);
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) {
    const auto [own, with_walls] = rows.gradients(r, p.velocity, a);
    gradient[a] = rows.is_blind(a) ? own : with_walls;
  }
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) {
    Vec2 force = Vec2::Zero();
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      const Vec2 way(g.x, g.y);
      if (b < n) {
        force += (viscosity[a] + viscosity[b]) * g.w * (p.velocity[b] - p.velocity[a]) -
                 (viscosity[a] * gradient[a] + viscosity[b] * gradient[b]) * way;
        return;
      }
      const std::int32_t root = r.ghosts.root(b - n);
      const Vec2 v = r.ghosts.from_root<Mirrors::motion>(b - n, Vec2(p.velocity[root]));
      if (!is_fixed_image(r, b))
        force +=
            (viscosity[a] + viscosity[b]) * g.w * (v - p.velocity[a]) -
            (viscosity[a] * gradient[a] + viscosity[b] * r.ghosts.flux_from_root(b - n, gradient[root])) *
                way;
      else if (!rows.is_blind(a))
        force += 2 * viscosity[a] * (g.w * (v - p.velocity[a]) - gradient[a] * way);
    });
    out[a] = force / (p.fill[a] * r.density[a]);
  }
}

}  // namespace porosph
