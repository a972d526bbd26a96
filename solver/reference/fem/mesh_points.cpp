#include "solver/reference/fem/mesh_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "solver/case/shapes.hpp"

namespace porosph {
namespace {

constexpr double clearance = 0.6;  ///< of a lattice point from the points on the lines, over the edge length

/// Fractions of the way from a to b at which the line is divided: equal steps of the integral of 1/size.
std::vector<double> divide(const Point& a, const Point& b, const MeshSize& size) {
  const double length = (b - a).norm();
  std::vector<double> at{0}, count{0};  // count: edges from a to there
  while (at.back() < 1) {
    const double step = size(a + at.back() * (b - a)) / 16 / length;
    const double next = at.back() + step > 1 - step / 2 ? 1 : at.back() + step;
    const double middle = (at.back() + next) / 2;
    count.push_back(count.back() + (next - at.back()) * length / size(a + middle * (b - a)));
    at.push_back(next);
  }
  const int pieces = std::max(1, static_cast<int>(std::ceil(count.back() - 0.05)));
  std::vector<double> inner;
  std::size_t k = 0;
  for (int i = 1; i < pieces; ++i) {
    const double wanted = count.back() * i / pieces;
    while (count[k + 1] < wanted) ++k;
    inner.push_back(at[k] + (at[k + 1] - at[k]) * (wanted - count[k]) / (count[k + 1] - count[k]));
  }
  return inner;
}

MeshPoints points_on_lines(const MeshLines& mesh, const MeshSize& size) {
  MeshPoints result{mesh.points, {}};
  for (const MeshLine& line : mesh.lines) {
    const Point &a = mesh.points[line.from], &b = mesh.points[line.to];
    int last = line.from;
    for (const double s : divide(a, b, size)) {
      result.points.push_back(a + s * (b - a));
      result.edges.push_back({last, static_cast<int>(result.points.size()) - 1});
      last = result.edges.back()[1];
    }
    result.edges.push_back({last, line.to});
  }
  return result;
}

/// Square bins of points, to ask whether one is near.
class Neighbourhood {
 public:
  explicit Neighbourhood(double width) : width_(width) {}
  void add(const Point& p) { bins_[key(bin(p.x()), bin(p.y()))].push_back(p); }

  /// Whether a point is nearer than `distance`, which is at most the bins' width.
  bool near(const Point& p, double distance) const {
    for (std::int64_t i = bin(p.x()) - 1; i <= bin(p.x()) + 1; ++i)
      for (std::int64_t j = bin(p.y()) - 1; j <= bin(p.y()) + 1; ++j)
        if (const auto found = bins_.find(key(i, j)); found != bins_.end())
          for (const Point& q : found->second)
            if ((p - q).norm() < distance) return true;
    return false;
  }

 private:
  std::int64_t bin(double x) const { return static_cast<std::int64_t>(std::floor(x / width_)); }
  static std::int64_t key(std::int64_t i, std::int64_t j) { return i * 1'000'003 + j; }

  double width_;
  std::unordered_map<std::int64_t, std::vector<Point>> bins_;
};

/// Cells of a triangular lattice, u along x and v at 60 degrees, halved until they are as small as `size`
/// asks; those without soil are left out early.
struct Lattice {
  const Case& scene;
  const MeshSize& size;
  Point origin;
  std::vector<Point> centres;

  bool near_soil(const Point& centre, double width) const {
    return std::any_of(scene.soils.begin(), scene.soils.end(),
                       [&](const SoilCase& soil) { return distance(centre, soil) <= width; });
  }
  void fill(double u, double v, double width) {
    const Point centre = origin + Point(u + v / 2, v * std::sqrt(0.75));
    if (width <= size(centre) * (1 + 1e-9)) {
      centres.push_back(centre);
      return;
    }
    if (width > 2 * size.h && !near_soil(centre, width)) return;
    for (const double du : {-0.25, 0.25})
      for (const double dv : {-0.25, 0.25}) fill(u + du * width, v + dv * width, width / 2);
  }
};

/// From one cell that covers the box, h times a power of two wide.
std::vector<Point> lattice_points(const Case& scene, const Eigen::AlignedBox2d& box, const MeshSize& size) {
  const double rows = box.sizes().y() / (size.h * std::sqrt(0.75)), columns = box.sizes().x() / size.h;
  const double half = size.h * std::exp2(std::ceil(std::log2(std::max(1.0, columns + rows / 2 + 1))));
  Lattice lattice{scene, size, box.min(), {}};
  lattice.fill(0, 0, 2 * half);
  return lattice.centres;
}

}  // namespace

MeshPoints mesh_points(const Case& scene, const MeshLines& lines, const MeshSize& size) {
  MeshPoints mesh = points_on_lines(lines, size);
  Neighbourhood taken(size.h);
  for (const Point& p : mesh.points) taken.add(p);
  for (const auto& [a, b] : mesh.edges) taken.add((mesh.points[a] + mesh.points[b]) / 2);
  Eigen::AlignedBox2d box;
  for (const Point& p : lines.points) box.extend(p);
  for (const Point& p : lattice_points(scene, box, size))
    if (!taken.near(p, clearance * size(p)) && soil_at(scene, p) >= 0) mesh.points.push_back(p);
  return mesh;
}

}  // namespace porosph
