// Compiled once for each kind of vector units, into a namespace of that name. Everything that it calls must
// be inlined: a function shared with other files could be linked in from here and be too wide for a
// processor.
#include "solver/sph/kernels/paper_kernels.hpp"

#include <algorithm>

#include "solver/sph/kernels/mid_step.hpp"
#include "solver/sph/kernels/soil_step.hpp"
#include "solver/sph/kernels/vectors.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

using Arrays = PaperArrays;

/// w of each pair, and the sums of L.
struct Geometry {
  const Arrays& c;
  Vector x, y;
  double per_h_squared = 1 / (c.smoothing_length * c.smoothing_length), inner = 3 * c.slope,
         inner_q = 2.25 * c.slope, outer = 0.75 * c.slope;
  Vector coincident = all(1e-30), xx{}, xy{}, yy{}, gx{}, gy{};

  template <class Own>
  Geometry(const Arrays& arrays, Own&& own)
      : c(arrays), x(own(c.points.position[0])), y(own(c.points.position[1])) {}

  template <class Of>
  void add(double* weight, Of&& of) {
    const Vector dx = of(c.points.position[0]) - x, dy = of(c.points.position[1]) - y;
    const Vector squared = (dx * dx + dy * dy) * per_h_squared;  // cubic spline, eq. (2)
    const Vector q2 = squared > coincident ? squared : coincident;
    const Vector per_q = inverse_square_root(q2), q = q2 * per_q;
    const Vector rest = 2 - q, t = rest > 0 ? rest : Vector{};
    const Vector w = of(c.points.volume) * (q < 1 ? inner - inner_q * q : outer * t * t * per_q);
    store(weight, w);
    const Vector x_part = w * dx, y_part = w * dy;
    xx += x_part * dx, xy += x_part * dy, yy += y_part * dy;
    gx += x_part, gy += y_part;
  }

  template <class Write>
  void finish(Write&& write) const {
    write(c.sum[Arrays::moment_xx], xx), write(c.sum[Arrays::moment_xy], xy),
        write(c.sum[Arrays::moment_yy], yy);
    write(c.sum[Arrays::gradient_x], gx), write(c.sum[Arrays::gradient_y], gy);
  }
};

template <bool rho_squared, bool viscous>
struct Forces {
  const Arrays& c;
  Vector x, y, vx{}, vy{}, rho{}, sound{};
  double h = c.smoothing_length, least = 0.01 * h * h;
  Vector xx_x{}, xx_y{}, xy_x{}, xy_y{}, yy_x{}, yy_y{}, fx{}, fy{}, px{}, py{}, rx{}, ry{};

  template <class Own>
  Forces(const Arrays& arrays, Own&& own)
      : c(arrays), x(own(c.points.position[0])), y(own(c.points.position[1])) {
    if (!viscous) return;
    vx = own(c.points.velocity[0]), vy = own(c.points.velocity[1]);
    rho = own(c.points.density), sound = own(c.points.sound);
  }

  template <class Of>
  void add(const double* weight, Of&& of) {
    const Vector dx = of(c.points.position[0]) - x, dy = of(c.points.position[1]) - y, w = load(weight);
    const Vector gx = w * dx, gy = w * dy;
    const Vector xx = of(c.points.stress[0]), yy = of(c.points.stress[1]), xy = of(c.points.stress[2]);
    xx_x += xx * gx, xx_y += xx * gy;
    xy_x += xy * gx, xy_y += xy * gy;
    yy_x += yy * gx, yy_y += yy * gy;
    Vector its_rho;
    if (rho_squared || viscous) its_rho = of(c.points.density);
    if (rho_squared) {
      const Vector p = of(c.points.pressure);
      px += p * gx, py += p * gy;
      rx += its_rho * gx, ry += its_rho * gy;
    }
    if (!viscous) return;
    // As ArtificialViscosity, with one division.
    const Vector approach = (of(c.points.velocity[0]) - vx) * dx + (of(c.points.velocity[1]) - vy) * dy;
    const Vector n = h * (approach < 0 ? approach : Vector{}), d = dx * dx + dy * dy + least;
    const Vector twice =
        n * (2 * c.viscosity.beta * n - c.viscosity.alpha * (sound + of(c.points.sound)) * d);
    const Vector force = its_rho * twice / ((rho + its_rho) * (d * d));
    fx += force * gx, fy += force * gy;
  }

  template <class Write>
  void finish(Write&& write) const {
    write(c.sum[Arrays::xx_x], xx_x), write(c.sum[Arrays::xx_y], xx_y);
    write(c.sum[Arrays::xy_x], xy_x), write(c.sum[Arrays::xy_y], xy_y);
    write(c.sum[Arrays::yy_x], yy_x), write(c.sum[Arrays::yy_y], yy_y);
    if (viscous) write(c.sum[Arrays::viscous_x], fx), write(c.sum[Arrays::viscous_y], fy);
    if (!rho_squared) return;
    write(c.sum[Arrays::pressure_x], px), write(c.sum[Arrays::pressure_y], py);
    write(c.sum[Arrays::density_x], rx), write(c.sum[Arrays::density_y], ry);
  }
};

struct Rates {
  const Arrays& c;
  Vector x, y, vx, vy;
  Vector xx{}, xy{}, yx{}, yy{};

  template <class Own>
  Rates(const Arrays& arrays, Own&& own)
      : c(arrays),
        x(own(c.points.position[0])),
        y(own(c.points.position[1])),
        vx(own(c.points.velocity[0])),
        vy(own(c.points.velocity[1])) {}

  template <class Of>
  void add(const double* weight, Of&& of) {
    const Vector w = load(weight);
    const Vector gx = w * (of(c.points.position[0]) - x), gy = w * (of(c.points.position[1]) - y);
    const Vector dvx = of(c.points.velocity[0]) - vx, dvy = of(c.points.velocity[1]) - vy;
    xx += dvx * gx, xy += dvx * gy;
    yx += dvy * gx, yy += dvy * gy;
  }

  template <class Write>
  void finish(Write&& write) const {
    write(c.sum[Arrays::rate_xx], xx), write(c.sum[Arrays::rate_xy], xy);
    write(c.sum[Arrays::rate_yx], yx), write(c.sum[Arrays::rate_yy], yy);
  }
};

/// Sums over the neighbours of `width` particles at once.
template <class Sums>
inline void shared_stretch(const Arrays& c, const PairLists::Stretch& stretch) {
  static_assert(width <= PairLists::widest);
  const std::int32_t* offset = c.lists->offset.data();
  double* weight = c.weight + stretch.weights;
  for (std::int32_t next = stretch.first; next < stretch.last; next += width) {
    const std::int32_t a = std::min(next, stretch.last - width);
    Sums sums(c, [a](const double* p) { return load(p + a); });
    for (std::int32_t k = stretch.pairs; k < stretch.pairs_end; ++k, weight += width) {
      const std::int32_t b = a + offset[k];
      sums.add(weight, [b](const double* p) { return load(p + b); });
    }
    sums.finish([a](double* p, const Vector& sum) { store(p + a, sum); });
  }
}

/// Sums over `width` neighbours of a particle at once. Those that fill up the list, the particle itself, have
/// g = 0.
template <class Sums>
inline void own_lists(const Arrays& c, const PairLists::Stretch& stretch) {
  const PairLists& lists = *c.lists;
  for (std::int32_t a = stretch.first; a < stretch.last; ++a) {
    Sums sums(c, [a](const double* p) { return all(p[a]); });
    for (std::int64_t k = lists.begin[a]; k < lists.begin[a + 1]; k += width) {
      const std::int32_t* index = lists.index.data() + k;
      sums.add(c.weight + k, [index](const double* p) { return gather(p, index); });
    }
    sums.finish([a](double* p, const Vector& sum) { p[a] = sum_of_lanes(sum); });
  }
}

template <class Sums>
void sums_over(const Arrays& c, std::int32_t number) {
  const PairLists::Stretch& stretch = c.lists->stretches[number];
  stretch.shared ? shared_stretch<Sums>(c, stretch) : own_lists<Sums>(c, stretch);
}

void forces(const Arrays& c, std::int32_t stretch) {
  const bool viscous = c.viscosity.alpha != 0 || c.viscosity.beta != 0;
  if (c.rho_squared)
    viscous ? sums_over<Forces<true, true>>(c, stretch) : sums_over<Forces<true, false>>(c, stretch);
  else
    viscous ? sums_over<Forces<false, true>>(c, stretch) : sums_over<Forces<false, false>>(c, stretch);
}

/// sum_b V_b (v_b - v_a) (x) L_a grad W_ab, of which eqs. (29) and (31) are the symmetric and the skew part.
/// What sticks to a wall moves against v_a.
void rates(const Arrays& c, std::int32_t number) {
  sums_over<Rates>(c, number);
  const PairLists::Stretch stretch = c.lists->stretches[number];
  const double *lxx = c.correction[0], *lxy = c.correction[1], *lyx = c.correction[2], *lyy = c.correction[3];
  const double *vx = c.points.velocity[0], *vy = c.points.velocity[1], *wx = c.wall_velocity[0],
               *wy = c.wall_velocity[1];
  double *xx = c.sum[Arrays::rate_xx], *xy = c.sum[Arrays::rate_xy];
  double *yx = c.sum[Arrays::rate_yx], *yy = c.sum[Arrays::rate_yy];
#pragma omp simd
  for (std::int32_t a = stretch.first; a < stretch.last; ++a) {
    const double axx = xx[a], axy = xy[a], ayx = yx[a], ayy = yy[a];
    xx[a] = axx * lxx[a] + axy * lxy[a] - vx[a] * wx[a], xy[a] = axx * lyx[a] + axy * lyy[a] - vx[a] * wy[a];
    yx[a] = ayx * lxx[a] + ayy * lxy[a] - vy[a] * wx[a], yy[a] = ayx * lyx[a] + ayy * lyy[a] - vy[a] * wy[a];
  }
}

/// What the step of a law reads and writes.
struct StepArrays {
  const double *xx, *xy, *yx, *yy;
  double *stress, *density;
  double half, dt;
};

/// In a function of its own: what a loop's body itself declares and hands on by reference stays in memory,
/// and the loop does not become vector code.
template <SoilLaw Law>
[[gnu::always_inline]] inline void particle_step(const StepArrays& t, std::int32_t a, const Law& law,
                                                 double* const* history) {
  const Gradient gradient = step_gradient({t.xx[a], t.xy[a], t.yx[a], t.yy[a]}, t.half);
  typename Law::History q = load_history<Law>(history, a);
  const double* old = t.stress + 4 * a;
  const Stress s = law.step(Stress{old[0], old[1], old[2], old[3]}, gradient, t.dt, q);
  store_history<Law>(history, a, q);
  double* now = t.stress + 4 * a;
  now[0] = s.xx, now[1] = s.yy, now[2] = s.zz, now[3] = s.xy;
  const double half_strain = t.half * gradient.trace();  // d(rho)/dt = -rho tr(D)
  t.density[a] *= (1 - half_strain) / (1 + half_strain);
}

/// Effective stress and density of particles `first` to `last - 1`, which have this law.
template <SoilLaw Law>
void material_step(const Arrays& c, std::int32_t first, std::int32_t last, const LawView& view, double dt) {
  const StepArrays t{c.sum[Arrays::rate_xx],
                     c.sum[Arrays::rate_xy],
                     c.sum[Arrays::rate_yx],
                     c.sum[Arrays::rate_yy],
                     c.soil.stress,
                     c.soil.density,
                     0.5 * dt,
                     dt};
  const Law law = *static_cast<const Law*>(view.law);
  double* history[history_size<Law> + 1];
  for (std::size_t k = 0; k < history_size<Law>; ++k) history[k] = view.history[k];
#pragma omp simd
  for (std::int32_t a = first; a < last; ++a) particle_step<Law>(t, a, law, history);
}

/// The same of a law that is called for all of them at once.
void external_step(const Arrays& c, std::int32_t first, std::int32_t last, const LawView& view, double dt) {
  constexpr std::int32_t longest = PairLists::longest;
  double gradient[4][longest];
  const std::int32_t count = last - first;
  const double half = 0.5 * dt;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t a = first + i;
    const Gradient g = step_gradient({c.sum[Arrays::rate_xx][a], c.sum[Arrays::rate_xy][a],
                                      c.sum[Arrays::rate_yx][a], c.sum[Arrays::rate_yy][a]},
                                     half);
    gradient[0][i] = g.xx, gradient[1][i] = g.xy, gradient[2][i] = g.yx, gradient[3][i] = g.yy;
    const double half_strain = half * g.trace();
    c.soil.density[a] *= (1 - half_strain) / (1 + half_strain);
  }
  double* history[LawView::most_history];
  for (std::size_t k = 0; k < view.history_count; ++k) history[k] = view.history[k] + first;
  static_cast<const ExternalLaw*>(view.law)->step(
      {.count = count,
       .dt = dt,
       .gradient = {gradient[0], gradient[1], gradient[2], gradient[3]},
       .stress = c.soil.stress + 4 * first,
       .history = {history, view.history_count}});
}

void strain(const Arrays& c, std::int32_t number, double dt) {
  rates(c, number);
  const PairLists::Stretch stretch = c.lists->stretches[number];
  for_each_soil(c.soil.soils, stretch.first, stretch.last,
                [&](std::int32_t first, std::int32_t last, const LawView& law, std::int32_t) {
                  if (law.kind == Laws::size)
                    external_step(c, first, last, law, dt);
                  else
                    with_law(Laws{}, law.kind,
                             [&]<class Law>() { material_step<Law>(c, first, last, law, dt); });
                });
}

}  // namespace

extern const PaperKernels paper_kernels;
const PaperKernels paper_kernels = {sums_over<Geometry>, forces, rates, strain};

}  // namespace porosph::POROSPH_VECTOR_UNITS
