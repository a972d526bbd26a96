#include "solver/run/beam.hpp"

#include <algorithm>
#include <cmath>

namespace porosph {

void BandMatrix::add(std::size_t i, std::size_t j, double value) {
  if (j <= i) rows_[i][i - j] += value;
}

void BandMatrix::hold(std::size_t i) {
  rows_[i] = {1};
  for (std::size_t k = 1; k < width && i + k < rows_.size(); ++k) rows_[i + k][k] = 0;
}

void BandMatrix::solve(std::vector<double>& x) {
  const std::size_t n = rows_.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = std::min(i, width - 1); k > 0; --k) {  // L(i, j) D(j), j = i - k
      const std::size_t j = i - k;
      for (std::size_t m = k + 1; m <= std::min(i, width - 1); ++m)
        rows_[i][k] -= rows_[i][m] * rows_[j][m - k];
    }
    for (std::size_t k = 1; k <= std::min(i, width - 1); ++k) {
      const double scaled = rows_[i][k] / rows_[i - k][0];
      rows_[i][0] -= rows_[i][k] * scaled;
      rows_[i][k] = scaled;
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 1; k <= std::min(i, width - 1); ++k) x[i] -= rows_[i][k] * x[i - k];
  for (std::size_t i = 0; i < n; ++i) x[i] /= rows_[i][0];
  for (std::size_t i = n; i-- > 0;)
    for (std::size_t k = 1; k <= std::min(i, width - 1); ++k) x[i - k] -= rows_[i][k] * x[i];
}

Beam::Beam(double length, std::size_t elements, double bending, double axial, double mass)
    : length_(length), elements_(elements) {
  const double l = element_length(), b = bending / (l * l * l), m = mass * l / 420;
  // Places of w1, theta1, w2, theta2; the usual matrices of Euler and Bernoulli's beam.
  constexpr std::size_t at[4] = {1, 2, 4, 5};
  const double stiff[4][4] = {{12, 6 * l, -12, 6 * l},
                              {6 * l, 4 * l * l, -6 * l, 2 * l * l},
                              {-12, -6 * l, 12, -6 * l},
                              {6 * l, 2 * l * l, -6 * l, 4 * l * l}};
  const double heavy[4][4] = {{156, 22 * l, 54, -13 * l},
                              {22 * l, 4 * l * l, 13 * l, -3 * l * l},
                              {54, 13 * l, 156, -22 * l},
                              {-13 * l, -3 * l * l, -22 * l, 4 * l * l}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      stiffness_[at[i]][at[j]] = b * stiff[i][j], mass_[at[i]][at[j]] = m * heavy[i][j];
  for (const std::size_t i : {0, 3})
    for (const std::size_t j : {0, 3}) {
      stiffness_[i][j] = (i == j ? 1 : -1) * axial / l;
      mass_[i][j] = (i == j ? 2 : 1) * mass * l / 6;
    }
}

Beam::Place Beam::place(double s) const {
  const double l = element_length();
  Place p;
  p.element = std::min(static_cast<std::size_t>(std::max(0.0, s / l)), elements_ - 1);
  const double x = s / l - static_cast<double>(p.element), y = 1 - x;
  p.along = {y, 0, 0, x, 0, 0};
  p.across = {0, y * y * (1 + 2 * x), l * x * y * y, 0, x * x * (1 + 2 * y), -l * x * x * y};
  return p;
}

Vec2 Beam::Place::of(const std::vector<double>& q) const {
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < per_element; ++i) sum += q[per_node * element + i] * Vec2(along[i], across[i]);
  return sum;
}

void Beam::add(const Matrix& of_element, double factor, BandMatrix& matrix) const {
  for (std::size_t e = 0; e < elements_; ++e)
    for (std::size_t i = 0; i < per_element; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        matrix.add(per_node * e + i, per_node * e + j, factor * of_element[i][j]);
}

void Beam::add_stiffness(double factor, BandMatrix& matrix) const { add(stiffness_, factor, matrix); }
void Beam::add_mass(double factor, BandMatrix& matrix) const { add(mass_, factor, matrix); }

std::vector<double> Beam::mass_times(const std::vector<double>& q) const {
  std::vector<double> product(size(), 0);
  for (std::size_t e = 0; e < elements_; ++e)
    for (std::size_t i = 0; i < per_element; ++i)
      for (std::size_t j = 0; j < per_element; ++j)
        product[per_node * e + i] += mass_[i][j] * q[per_node * e + j];
  return product;
}

void Beam::add_force(const Place& at, const Vec2& force, std::vector<double>& forces) {
  for (std::size_t i = 0; i < per_element; ++i)
    forces[per_node * at.element + i] += force.x() * at.along[i] + force.y() * at.across[i];
}

Beam::Of Beam::spread_on_element(const Vec2& force) const {
  const double l = element_length(), u = force.x() * l / 2, w = force.y() * l / 2;
  return {u, w, w * l / 6, u, w, -w * l / 6};
}

void Beam::add_spread(const std::vector<Vec2>& of_elements, std::vector<double>& forces) const {
  for (std::size_t e = 0; e < elements_; ++e) {
    const Of share = spread_on_element(of_elements[e]);
    for (std::size_t i = 0; i < per_element; ++i) forces[per_node * e + i] += share[i];
  }
}

/// What the nodes do to each element, which the two at a node agree on but for forces on the node itself.
std::vector<Beam::Section> Beam::sections(const std::vector<double>& q, const std::vector<PointForce>& forces,
                                          const std::vector<Vec2>& spread) const {
  std::vector<Of> end_forces(elements_);
  for (std::size_t e = 0; e < elements_; ++e) {
    const Of share = spread_on_element(spread[e]);
    for (std::size_t i = 0; i < per_element; ++i) {
      end_forces[e][i] = -share[i];
      for (std::size_t j = 0; j < per_element; ++j)
        end_forces[e][i] += stiffness_[i][j] * q[per_node * e + j];
    }
  }
  for (const PointForce& f : forces)
    for (std::size_t i = 0; i < per_element; ++i)
      end_forces[f.at.element][i] -= f.force.x() * f.at.along[i] + f.force.y() * f.at.across[i];
  std::vector<Section> sections(nodes());
  for (std::size_t k = 0; k < nodes(); ++k) {
    const auto add = [&](const Of& end, std::size_t first, double sign, double weight) {
      sections[k].axial -= weight * sign * end[first];
      sections[k].shear += weight * sign * end[first + 1];
      sections[k].moment -= weight * sign * end[first + 2];
    };
    const double weight = k > 0 && k < elements_ ? 0.5 : 1;
    if (k < elements_) add(end_forces[k], 0, 1, weight);
    if (k > 0) add(end_forces[k - 1], per_node, -1, weight);
  }
  return sections;
}

}  // namespace porosph
