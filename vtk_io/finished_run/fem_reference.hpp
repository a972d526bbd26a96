// The finite-element reference that `porosph fem` wrote, asked at any point.
#pragma once

#include <filesystem>
#include <map>
#include <optional>

#include "solver/analysis/frame_values.hpp"
#include "solver/case/case.hpp"
#include "solver/reference/fem/p4_triangle.hpp"
#include "solver/reference/fem/triangle_locator.hpp"

namespace porosph {

class FemReference {
 public:
  /// `folder` holds fem.vtu and case.toml. Throws ReadError if the file is not such a reference, or
  /// CaseError.
  explicit FemReference(const std::filesystem::path& folder);

  bool covers(const Point& point) const;  ///< [m], at t = 0

  /// At points at t = 0 [m], by the elements' own shape functions, or computed from such values; NaN outside
  /// of the mesh. Throws std::runtime_error for a field or component that the reference does not have.
  std::vector<double> values(const FieldSelection& field, const std::vector<Point>& points) const;

  /// All fields at points at t = 0 [m], as a frame at the places to which the points come.
  Frame state(const std::vector<Point>& points) const;

  const Case& scene() const { return scene_; }

 private:
  Case scene_;
  Mesh mesh_;
  std::vector<std::array<int, p4::node_count>> triangles_;
  std::map<std::string, std::vector<double>> arrays_;  ///< per node, by FieldSelection::text()
  std::vector<FrameField> fields_;                     ///< names and components, without values
  std::optional<TriangleLocator> locator_;
};

}  // namespace porosph
