#include "solver/reference/fem/biot_equations.hpp"

#include <cmath>
#include <stdexcept>

namespace porosph {
namespace {

constexpr double softer = 1e-6;  // of the soil's own compressibility
constexpr double balanced = 1e-10;
constexpr int most_refinements = 30;

}  // namespace

BiotEquations::BiotEquations(Eigen::SparseMatrix<double> stiffness, PoreFlow flow, double unit_weight)
    : stiffness_(std::move(stiffness)), flow_(std::move(flow)), unit_weight_(unit_weight) {}

void BiotEquations::number_heads() {
  int next = static_cast<int>(stiffness_.rows());
  unknown_.clear();
  for (const double given : flow_.given) unknown_.push_back(*tau_ > 0 && !std::isnan(given) ? -1 : next++);
  scale_.resize(next);
}

void BiotEquations::set(double tau) {
  if (tau_ && std::abs(*tau_ - tau) <= 1e-12 * tau) return;
  tau_ = tau;
  number_heads();
  const Eigen::Index soil = stiffness_.rows();
  std::vector<Eigen::Triplet<double>> lower;
  const auto add = [&](const Eigen::SparseMatrix<double>& m, double factor, auto&& row_of, auto&& column_of) {
    for (Eigen::Index k = 0; k < m.outerSize(); ++k)
      for (Eigen::SparseMatrix<double>::InnerIterator it(m, k); it; ++it) {
        const auto row = static_cast<int>(row_of(it)), column = static_cast<int>(column_of(it));
        if (column >= 0 && row >= column) lower.emplace_back(row, column, factor * it.value());
      }
  };
  const auto head_row = [&](const auto& it) { return unknown_[it.row()]; };
  const auto head_column = [&](const auto& it) { return unknown_[it.col()]; };
  add(
      stiffness_, 1, [](const auto& it) { return it.row(); }, [](const auto& it) { return it.col(); });
  add(flow_.opening, -unit_weight_, head_column, [](const auto& it) { return it.row(); });
  add(flow_.storage, -unit_weight_, head_row, head_column);
  add(flow_.softness, tau > 0 ? 0 : -unit_weight_ * softer, head_row, head_column);
  add(flow_.conductivity, -unit_weight_ * tau, head_row, head_column);
  Eigen::SparseMatrix<double> matrix(scale_.size(), scale_.size());
  matrix.setFromTriplets(lower.begin(), lower.end());
  scale_.head(soil) = stiffness_.diagonal();
  for (std::size_t n = 0; n < unknown_.size(); ++n)
    if (unknown_[n] >= 0) {
      const auto k = static_cast<Eigen::Index>(n);
      scale_[unknown_[n]] = unit_weight_ * (flow_.storage.coeff(k, k) + flow_.softness.coeff(k, k) +
                                            tau * flow_.conductivity.coeff(k, k));
    }
  scale_ = scale_.array().rsqrt();
  const Eigen::SparseMatrix<double> scaled = scale_.asDiagonal() * matrix * scale_.asDiagonal();
  factors_.compute(scaled);
  if (!scale_.allFinite() || factors_.info() != Eigen::Success)
    throw std::runtime_error("finite elements: the equations of consolidation cannot be solved");
}

Eigen::VectorXd BiotEquations::unbalanced(const Eigen::VectorXd& load, const Eigen::VectorXd& water,
                                          const Eigen::VectorXd& u, const Eigen::VectorXd& h) const {
  const Eigen::Index soil = stiffness_.rows();
  Eigen::VectorXd left(scale_.size());
  left.head(soil) =
      load - stiffness_.selfadjointView<Eigen::Lower>() * u + unit_weight_ * (flow_.opening * h);
  const Eigen::VectorXd missing =
      water - flow_.opening.transpose() * u - flow_.storage * h - *tau_ * (flow_.conductivity * h);
  for (std::size_t n = 0; n < unknown_.size(); ++n)
    if (unknown_[n] >= 0) left[unknown_[n]] = -unit_weight_ * missing[static_cast<Eigen::Index>(n)];
  return scale_.cwiseProduct(left);
}

void BiotEquations::solve(const Eigen::VectorXd& load, const Eigen::VectorXd& water, Eigen::VectorXd& u,
                          Eigen::VectorXd& h) const {
  u.setZero(stiffness_.rows()), h.setZero(static_cast<Eigen::Index>(unknown_.size()));
  for (std::size_t n = 0; n < unknown_.size(); ++n)
    if (unknown_[n] < 0) h[static_cast<Eigen::Index>(n)] = flow_.given[n];
  Eigen::VectorXd left = unbalanced(load, water, u, h);
  const double size = left.norm();
  for (int i = 0; i < most_refinements && left.norm() > balanced * size; ++i) {
    const Eigen::VectorXd change = scale_.cwiseProduct(factors_.solve(left));
    u += change.head(stiffness_.rows());
    for (std::size_t n = 0; n < unknown_.size(); ++n)
      if (unknown_[n] >= 0) h[static_cast<Eigen::Index>(n)] += change[unknown_[n]];
    left = unbalanced(load, water, u, h);
  }
  if (!(left.norm() <= balanced * size))
    throw std::runtime_error("finite elements: rounding spoils the equations of consolidation");
}

}  // namespace porosph
