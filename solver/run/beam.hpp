// An elastic beam on a straight line: its nodes, its stiffness, and what it carries.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solver/space/tensor.hpp"

namespace porosph {

/// A symmetric positive matrix whose entries are at most five places off its diagonal.
class BandMatrix {
 public:
  explicit BandMatrix(std::size_t size) : rows_(size) {}
  void add(std::size_t i, std::size_t j, double value);
  /// Makes row and column i those of the unit matrix.
  void hold(std::size_t i);
  /// Takes the right side's place. Cholesky's L D L^T, which takes the matrix's.
  void solve(std::vector<double>& right);

 private:
  static constexpr std::size_t width = 6;
  std::vector<std::array<double, width>> rows_;  ///< [k]: entry (i, i - k)
};

/// Of equal elements, with cubic deflections between their nodes (Hermite) and linear displacements along
/// them. Its degrees of freedom are u, w and theta of each node: displacement along the beam, across it
/// towards its left, and the slope dw/ds.
class Beam {
 public:
  static constexpr std::size_t per_node = 3, per_element = 6;
  using Of = std::array<double, per_element>;  ///< what belongs to an element's degrees of freedom

  /// EI [N m], EA [N/m] and mass [kg/m2], per metre of thickness.
  Beam(double length, std::size_t elements, double bending, double axial, double mass);

  std::size_t nodes() const { return elements_ + 1; }
  std::size_t size() const { return per_node * nodes(); }
  double element_length() const { return length_ / static_cast<double>(elements_); }  ///< [m]

  /// A place on the beam: the element that it is in, and what its degrees of freedom are there.
  struct Place {
    std::size_t element = 0;
    Of along{}, across{};  ///< u = along . q, w = across . q
    /// (u, w) there.
    Vec2 of(const std::vector<double>& q) const;
  };
  Place place(double s) const;  ///< at a distance from its beginning [m]

  void add_stiffness(double factor, BandMatrix& matrix) const;
  void add_mass(double factor, BandMatrix& matrix) const;
  std::vector<double> mass_times(const std::vector<double>& q) const;
  /// Adds a force (along, across) at a place [N/m].
  static void add_force(const Place& at, const Vec2& force, std::vector<double>& forces);
  /// Adds a force per length (along, across) on each element [Pa].
  void add_spread(const std::vector<Vec2>& of_elements, std::vector<double>& forces) const;

  /// What a cross-section carries.
  struct Section {
    double axial = 0;   ///< tension [N/m]
    double shear = 0;   ///< dM/ds [N/m]
    double moment = 0;  ///< EI d2w/ds2: positive where the left side is concave [N]
  };
  struct PointForce {
    Place at;
    Vec2 force;  ///< (along, across) [N/m]
  };
  /// At the nodes, deformed by q under forces within the elements and those spread over each.
  std::vector<Section> sections(const std::vector<double>& q, const std::vector<PointForce>& forces,
                                const std::vector<Vec2>& spread) const;

 private:
  using Matrix = std::array<std::array<double, per_element>, per_element>;
  void add(const Matrix& of_element, double factor, BandMatrix& matrix) const;
  Of spread_on_element(const Vec2& force) const;

  double length_;
  std::size_t elements_;
  Matrix stiffness_{}, mass_{};
};

}  // namespace porosph
