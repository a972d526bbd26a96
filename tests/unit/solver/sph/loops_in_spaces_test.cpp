// The hot loops of the consistent form in the plane, around an axis and in space.
#include <catch2/catch.hpp>

#define POROSPH_VECTOR_UNITS of_this_test
#include "solver/sph/kernels/consistent_loops.hpp"
#undef POROSPH_VECTOR_UNITS

#include <Eigen/Dense>

#include "solver/sph/correction/kernel_correction.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;
using of_this_test::loops_in;

namespace {

constexpr double spacing = 0.5, axis_distance = 3, density = 1900, dt = 0.01;
constexpr double slight = 0.1;  // disorder; at 0.2 some corners of solids have too few neighbours

Vec2 gradient_of(const PairGeometry& g) { return {g.x, g.y}; }
Vec3 gradient_of(const PairGeometryIn<double, 3>& g) { return {g.x, g.y, g.z}; }

template <class Space>
std::vector<VectorIn<Space>> block(int side, double disorder) {
  Noise noise(7);
  std::vector<VectorIn<Space>> points;
  for (int k = 0; k < (Space::dim == 3 ? side : 1); ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const double place[3] = {axis_distance / spacing + i, double(j), double(k)};
        VectorIn<Space> x;
        for (int d = 0; d < Space::dim; ++d) x[d] = spacing * (place[d] + disorder * noise());
        points.push_back(x);
      }
  return points;
}

template <class Space>
PairStencilsIn<Space> stencils_of(const std::vector<VectorIn<Space>>& points) {
  const CubicSpline<Space::dim> kernel(1.2 * spacing);
  const std::vector<double> volumes(points.size(), std::pow(spacing, Space::dim));
  return make_pair_stencils_in<Space>(points, stencil_neighbours(points, points.size(), kernel), volumes,
                                      kernel);
}

/// A matrix as three-dimensional, the hoop last where there is one, and 1 or 0 where there is nothing.
template <class Space>
Mat3 in_space(const MatrixIn<Space>& m, double rest) {
  Mat3 out = Mat3::Identity() * rest;
  out.topLeftCorner<Space::dim, Space::dim>() = m;
  return out;
}
template <class Space>
Mat3 in_space(const Symmetric<Space>& s) {
  Mat3 m = (Mat3() << s.xx, s.xy, 0, s.xy, s.yy, 0, 0, 0, s.zz).finished();
  if constexpr (Space::dim == 3) m(0, 2) = m(2, 0) = s.xz, m(1, 2) = m(2, 1) = s.yz;
  return m;
}

/// Soil in a block of particles, with all that the loops read and write.
template <class Space>
struct Block {
  static constexpr int dim = Space::dim, matrix = matrix_size<Space>, gradients = gradient_size<Space>;
  using Numbers = std::vector<double>;

  explicit Block(double disorder, int side = 10)
      : points(block<Space>(side, disorder)), stencils(stencils_of<Space>(points)) {
    const std::size_t n = points.size();
    for (Numbers* one : {&radius, &hoop, &pressure}) one->assign(n, 0);
    reference_density.assign(n, density), present_density.assign(n, density), fill.assign(n, 1);
    for (auto& c : correction) c.resize(n);
    for (auto& v : velocity) v.assign(n, 0);
    for (auto& f : flux) f.assign(n, 0);
    for (auto& p : piola) p.resize(n);
    for (int k = 0; k < gradients; ++k) deformation[k].assign(n, k == matrix || k % (dim + 1) == 0 ? 1 : 0);
    stress.resize(n), listed.assign(n, 1), records.resize(n);
    accelerations.resize(dim * n);
    for (std::size_t a = 0; a < n; ++a) {
      radius[a] = points[a][0];
      MatrixIn<Space> moment = MatrixIn<Space>::Zero();
      stencils.for_neighbours(static_cast<std::int32_t>(a), [&](std::int32_t b, const auto& g) {
        moment += gradient_of(g) * (points[b] - points[a]).transpose();
      });
      const MatrixIn<Space> l = correction_matrix(moment);
      for (int k = 0; k < matrix; ++k) correction[k][a] = l(k / dim, k % dim);
    }
  }

  /// Gives the particles the velocity slope * x.
  void move(const MatrixIn<Space>& slope) {
    for (std::size_t a = 0; a < points.size(); ++a) {
      const VectorIn<Space> v = slope * points[a];
      for (int d = 0; d < dim; ++d) velocity[d][a] = records[a].q[RecordIn<Space>::velocity + d] = v[d];
    }
  }
  void set_pressure(const VectorIn<Space>& slope) {
    for (std::size_t a = 0; a < points.size(); ++a)
      pressure[a] = records[a].q[RecordIn<Space>::pressure] = slope.dot(points[a]);
  }
  bool is_inside(std::size_t a) const {
    for (int d = 0; d < dim; ++d) {
      const double from_start = points[a][d] - points.front()[d], from_end = points.back()[d] - points[a][d];
      if (std::min(from_start, from_end) < 4.9 * spacing) return false;  // twice the support
    }
    return true;
  }

  /// Of soil with this law, the `kind`-th in the list.
  template <class Law>
  ConsistentArraysIn<Space> arrays(const Law& law, std::size_t kind, double viscosity = 0, bool wet = false) {
    const auto n = static_cast<std::int32_t>(points.size());
    history.assign(history_size<Law>, Numbers(n, 0));
    history_of.clear();
    for (Numbers& h : history) history_of.push_back(h.data());
    laws = {{kind, &law, history_of.data(), history_of.size(), kind != 0}};
    ranges = {{0, n, 0, -1}};
    ConsistentArraysIn<Space> c{};
    for (int k = 0; k < matrix; ++k)
      c.reference.correction[k] = correction[k].data(), c.fluxes.flux[k] = flux[k].data(),
      c.fluxes.piola[k] = piola[k].data();
    for (int k = 0; k < gradients; ++k) c.state.deformation[k] = deformation[k].data();
    for (int d = 0; d < dim; ++d) c.motion.velocity[d] = c.motion.controlled[d] = velocity[d].data();
    c.reference.stencils = &stencils, c.reference.density = reference_density.data();
    c.reference.fill = fill.data(), c.reference.radius = radius.data();
    c.motion.pressure = wet ? pressure.data() : nullptr;
    c.state.soils = {ranges.data(), 1, laws.data()};
    c.state.stress = &stress.front().xx, c.state.density = present_density.data();
    c.fluxes.listed = listed.data(), c.fluxes.mirrored = listed.data(), c.fluxes.records = records.data();
    c.fluxes.hoop = hoop.data();
    c.control = {viscosity, &no_spring, 0};
    for (std::size_t a = 0; a < points.size(); ++a)
      records[a].q[RecordIn<Space>::viscosity] = viscosity * (has_hoop<Space> ? radius[a] : 1);
    for (int d = 0; d < dim; ++d) c.gravity[d] = gravity[d];
    return c;
  }

  VectorIn<Space> accelerated(const ConsistentArraysIn<Space>& c, std::size_t particle) {
    for (std::int32_t tile = 0; tile < stencils.tiles(); ++tile)
      loops_in<Space>.accelerate(c, tile, accelerations.data());
    return Eigen::Map<VectorIn<Space>>(accelerations.data() + dim * particle);
  }
  LargestChange strain(const ConsistentArraysIn<Space>& c) {
    LargestChange largest;
    for (std::int32_t tile = 0; tile < stencils.tiles(); ++tile) loops_in<Space>.strain(c, tile, dt, largest);
    return largest;
  }

  std::vector<VectorIn<Space>> points;
  PairStencilsIn<Space> stencils;
  Numbers reference_density, present_density, fill, radius, hoop, pressure, accelerations;
  Numbers correction[matrix], velocity[dim], deformation[gradients], flux[matrix], piola[matrix];
  std::vector<Symmetric<Space>> stress;
  std::vector<std::uint8_t> listed;
  std::vector<RecordIn<Space>> records;
  std::vector<Numbers> history;
  std::vector<double*> history_of;
  std::vector<LawView> laws;
  std::vector<SoilRange> ranges;
  VectorIn<Space> gravity = VectorIn<Space>::Constant(-9.81);
  double no_spring = 0;
};

const LinearElastic elastic = LinearElastic::from_young(15e6, 0.3);

template <class Space>
MatrixIn<Space> some_slope() {
  const Mat3 all = (Mat3() << 0.9, -0.4, 0.3, 0.7, -0.5, 0.2, -0.6, 0.8, 1.1).finished();
  MatrixIn<Space> slope = all.topLeftCorner<Space::dim, Space::dim>();
  if (has_hoop<Space>) slope(0, 1) = 0;  // or the hoop would strain differently from place to place
  return slope;
}
template <class Space>
Mat3 with_hoop(const MatrixIn<Space>& slope) {
  return in_space<Space>(slope, has_hoop<Space> ? slope(0, 0) : 0);
}

/// Hughes and Winget's step, written with matrices.
Mat3 stress_after(const Mat3& old, const Mat3& slope) {
  const Mat3 one = Mat3::Identity(), g = slope * (one + 0.5 * dt * slope).inverse();
  const Mat3 spin = 0.5 * dt * (g - g.transpose()) / 2, d = 0.5 * dt * (g + g.transpose());
  const Mat3 turn = (one - spin).inverse() * (one + spin);
  const double lambda = elastic.bulk_modulus - 2 * elastic.shear_modulus / 3;
  return turn * old * turn.transpose() + lambda * d.trace() * one + 2 * elastic.shear_modulus * d;
}

template <class Space>
Symmetric<Space> some_stress() {
  Symmetric<Space> s{-40e3, -70e3, -40e3, 9e3};
  if constexpr (Space::dim == 3) s.yz = -5e3, s.xz = 7e3;
  return s;
}

}  // namespace

TEMPLATE_TEST_CASE("the loops' gradients of linear velocities are exact in every space", "[space]", Plane,
                   Axisymmetric, Solid) {
  const double disorder = GENERATE(0.0, slight);
  Block<TestType> soil(disorder);
  const auto slope = some_slope<TestType>();
  soil.move(slope);
  const auto c = soil.arrays(elastic, 0);
  constexpr int size = gradient_size<TestType>, dim = TestType::dim;
  double worst = 0;
  for (std::int32_t tile = 0; tile < soil.stencils.tiles(); ++tile) {
    std::vector<double> rates(size * PairStencils::tile);
    loops_in<TestType>.rates(c, tile, rates.data());
    const std::size_t first = std::size_t(tile) * PairStencils::tile;
    for (std::size_t i = 0; i < std::min<std::size_t>(PairStencils::tile, soil.points.size() - first); ++i) {
      for (int k = 0; k < dim * dim; ++k)
        worst = std::max(worst, std::abs(rates[size * i + k] - slope(k / dim, k % dim)));
      if (has_hoop<TestType>) worst = std::max(worst, std::abs(rates[size * i + dim * dim] - slope(0, 0)));
    }
  }
  CHECK(worst < 1e-12);
}

TEMPLATE_TEST_CASE("an elastic step of the loops gives the exact stress in every space", "[space]", Plane,
                   Axisymmetric, Solid) {
  const bool yielding = GENERATE(false, true);
  Block<TestType> soil(slight, 8);
  const auto slope = some_slope<TestType>();
  soil.move(slope);
  soil.stress.assign(soil.points.size(), some_stress<TestType>());
  const auto strong = DruckerPrager::from_mohr_coulomb(elastic, 1e12, 0);
  const auto c = yielding ? soil.arrays(strong, 1) : soil.arrays(elastic, 0);
  const LargestChange largest = soil.strain(c);

  const Mat3 stress = stress_after(in_space(some_stress<TestType>()), with_hoop<TestType>(slope));
  const Mat3 f = Mat3::Identity() + dt * with_hoop<TestType>(slope);
  const Mat3 piola = f.determinant() * stress * f.inverse().transpose();
  double stress_error = 0, density_error = 0, piola_error = 0;
  for (std::size_t a = 0; a < soil.points.size(); ++a) {
    stress_error = std::max(stress_error, (in_space(soil.stress[a]) - stress).cwiseAbs().maxCoeff());
    density_error = std::max(density_error, std::abs(soil.present_density[a] - density / f.determinant()));
    for (int k = 0; k < soil.matrix; ++k)
      piola_error = std::max(piola_error, std::abs(soil.piola[k][a] - piola(k / soil.dim, k % soil.dim)));
    if (has_hoop<TestType>) piola_error = std::max(piola_error, std::abs(soil.hoop[a] - piola(2, 2)));
  }
  CHECK(stress_error < 1e-9 * stress.norm());
  CHECK(piola_error < 1e-9 * stress.norm());
  CHECK(density_error < 1e-9 * density);
  CHECK(largest.strain == Approx((f - Mat3::Identity()).cwiseAbs().maxCoeff()));
}

TEMPLATE_TEST_CASE("uniform stress accelerates particles of a lattice as it should in every space", "[space]",
                   Plane, Axisymmetric, Solid) {
  Block<TestType> soil(0, 12);
  soil.move(some_slope<TestType>());
  soil.stress.assign(soil.points.size(), some_stress<TestType>());
  const auto c = soil.arrays(elastic, 0, 2e4);  // the control lets linear motion pass
  soil.strain(c);
  int inside = 0;
  double worst = 0;
  for (std::size_t a = 0; a < soil.points.size(); ++a) {
    if (!soil.is_inside(a)) continue;
    ++inside;
    VectorIn<TestType> expected = soil.gravity;
    if (has_hoop<TestType>) {  // what the radius adds to the divergence
      expected[0] += (soil.piola[0][a] - soil.hoop[a]) / (soil.radius[a] * density);
      expected[1] += soil.piola[2][a] / (soil.radius[a] * density);
    }
    worst = std::max(worst, (soil.accelerated(c, a) - expected).norm());
  }
  CHECK(inside > 0);
  CHECK(worst < 1e-9);
}

TEMPLATE_TEST_CASE("a linear pore pressure acts exactly in every space", "[space]", Plane, Axisymmetric,
                   Solid) {
  Block<TestType> soil(GENERATE(0.0, slight), 8);
  const auto slope = some_slope<TestType>();
  VectorIn<TestType> pressure_slope;
  for (int d = 0; d < soil.dim; ++d) pressure_slope[d] = 1e3 * (d + 2);
  soil.set_pressure(pressure_slope);
  const Mat3 f = Mat3::Identity() + dt * with_hoop<TestType>(slope);
  for (int k = 0; k < soil.gradients; ++k)
    std::ranges::fill(soil.deformation[k], k == soil.matrix ? f(2, 2) : f(k / soil.dim, k % soil.dim));
  const auto c = soil.arrays(elastic, 0, 0, true);
  const Mat3 cofactor = f.determinant() * f.inverse().transpose();
  const VectorIn<TestType> expected =
      soil.gravity + cofactor.topLeftCorner<TestType::dim, TestType::dim>() * pressure_slope / density;
  double worst = (soil.accelerated(c, 0) - expected).norm();
  for (std::size_t a = 0; a < soil.points.size(); ++a)
    worst = std::max(
        worst, (Eigen::Map<VectorIn<TestType>>(soil.accelerations.data() + soil.dim * a) - expected).norm());
  CHECK(worst < 1e-10);
}
