// Stencils and corrections in the plane, around an axis and in space.
#include <catch2/catch.hpp>

#include "solver/sph/consistent/pair_stencils.hpp"
#include "solver/sph/correction/kernel_correction.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

template <class Space>
std::vector<VectorIn<Space>> block(int side, double disorder) {
  Noise noise(5);
  std::vector<VectorIn<Space>> points;
  for (int k = 0; k < (Space::dim == 3 ? side : 1); ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const int place[3] = {i, j, k};
        VectorIn<Space> x;
        for (int d = 0; d < Space::dim; ++d) x[d] = place[d] + disorder * noise();
        points.push_back(x);
      }
  return points;
}

Vec2 gradient_of(const PairGeometry& g) { return {g.x, g.y}; }
Vec3 gradient_of(const PairGeometryIn<double, 3>& g) { return {g.x, g.y, g.z}; }

/// The largest error of the corrected gradient of a linear field, over all points, also at faces and corners.
template <class Space>
double error_of_linear_field(double disorder, bool single) {
  const auto points = block<Space>(10, disorder);
  const std::vector<double> volumes(points.size(), 1);
  const CubicSpline<Space::dim> kernel(1.2);
  const auto stencils = make_pair_stencils_in<Space>(
      points, stencil_neighbours(points, points.size(), kernel), volumes, kernel, single);
  VectorIn<Space> slope;
  for (int d = 0; d < Space::dim; ++d) slope[d] = 1 + d;
  double worst = 0;
  for (std::int32_t a = 0; a < stencils.particles(); ++a) {
    MatrixIn<Space> moment = MatrixIn<Space>::Zero();
    VectorIn<Space> gradient = VectorIn<Space>::Zero();
    stencils.for_neighbours(a, [&](std::int32_t b, const auto& g) {
      const VectorIn<Space> to_b = points[b] - points[a];
      moment += gradient_of(g) * to_b.transpose();
      gradient += slope.dot(to_b) * gradient_of(g);
    });
    worst = std::max(worst, (correction_matrix(moment) * gradient - slope).norm());
  }
  return worst;
}

}  // namespace

TEMPLATE_TEST_CASE("corrected gradients of linear fields are exact in every space", "[space]", Plane,
                   Axisymmetric, Solid) {
  CHECK(error_of_linear_field<TestType>(0, false) < 1e-12);
  CHECK(error_of_linear_field<TestType>(0.2, false) < 1e-12);
  CHECK(error_of_linear_field<TestType>(0.2, true) < 1e-5);
}

TEST_CASE("particles of a lattice share their stencils in space as well", "[space]") {
  const auto points = block<Solid>(16, 0);
  const std::vector<double> volumes(points.size(), 1);
  const CubicSpline<3> kernel(1.2);
  const auto stencils = make_pair_stencils_in<Solid>(
      points, stencil_neighbours(points, points.size(), kernel), volumes, kernel);
  const auto alone = std::ranges::count(stencils.stretch_of, PairStencilsIn<Solid>::own_list);
  CHECK(alone == 16 * 16 * 4);  // two at either end of each row
}

TEST_CASE("no gradient in space grows without bound where the neighbours do not span it", "[space]") {
  for (const Vec3& diagonal : {Vec3(1, 1, 0), Vec3(0.3, 0, 0), Vec3(0, 0, 0), Vec3(1, 0.5, 0.01)}) {
    const Mat3 l = correction_matrix(Mat3(diagonal.asDiagonal()));
    CHECK(l.norm() <= std::sqrt(3.0) * 10);
    CHECK(l.allFinite());
  }
  const Mat3 row = Vec3(0.8, 0, 0).asDiagonal();
  CHECK((correction_matrix(row) * row * Vec3::UnitX() - Vec3::UnitX()).norm() < 1e-14);
}
