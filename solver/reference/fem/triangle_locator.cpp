#include "solver/reference/fem/triangle_locator.hpp"

#include <cmath>

namespace porosph {

TriangleLocator::TriangleLocator(const Mesh& mesh) {
  for (const Point& p : mesh.vertices) box_.extend(p);
  const double margin = 1e-7 * box_.diagonal().norm();
  box_ = Eigen::AlignedBox2d(box_.min().array() - margin, box_.max().array() + margin);
  width_ = std::sqrt(box_.volume() / static_cast<double>(mesh.triangles.size()));
  bins_ = (box_.sizes().array() / width_).ceil().cast<int>().max(1);
  triangles_.resize(bins_.prod());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    Eigen::AlignedBox2d around;
    for (const int v : mesh.triangles[t]) around.extend(mesh.vertices[v]);
    const Point slack = Point::Constant(1e-7 * around.diagonal().norm());
    const Eigen::Array2i low = bin_of(around.min() - slack), high = bin_of(around.max() + slack);
    for (int j = low.y(); j <= high.y(); ++j)
      for (int i = low.x(); i <= high.x(); ++i) triangles_[j * bins_.x() + i].push_back(t);
  }
}

Eigen::Array2i TriangleLocator::bin_of(const Point& p) const {
  return ((p - box_.min()).array() / width_).floor().cast<int>().max(0).min(bins_ - 1);
}

std::vector<TriangleLocator::Hit> TriangleLocator::find(const Mesh& mesh, const Point& p) const {
  std::vector<Hit> hits;
  if (!box_.contains(p)) return hits;
  const Eigen::Array2i bin = bin_of(p);
  for (const int t : triangles_[bin.y() * bins_.x() + bin.x()]) {
    const auto& v = mesh.triangles[t];
    const Point &a = mesh.vertices[v[0]], &b = mesh.vertices[v[1]], &c = mesh.vertices[v[2]];
    const p4::Barycentric at =
        p4::Barycentric(twice_area(p, b, c), twice_area(a, p, c), twice_area(a, b, p)) / twice_area(a, b, c);
    if (at.minCoeff() >= -1e-8) hits.push_back({t, at});
  }
  return hits;
}

}  // namespace porosph
