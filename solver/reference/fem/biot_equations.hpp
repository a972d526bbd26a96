// The equations of saturated soil and its water at one instant, solved for displacement and excess head.
#pragma once

#include <Eigen/SparseCholesky>
#include <optional>

#include "solver/reference/fem/assemble.hpp"
#include "solver/reference/fem/pore_flow.hpp"

namespace porosph {

/// With the stiffness K of the soil and gamma_w of the water (pore_flow.hpp has the rest),
///
///   K u - gamma_w C h = f,      C^T u + (S + tau H) h = W,
///
/// times -gamma_w in the second line symmetric and quasi-definite, so that L D L^T needs no pivots (Vanderbei
/// 1995). With tau = 0 and incompressible water the diagonal of h vanishes: the factors are then those of a
/// slightly softer water, and refinement takes that back.
class BiotEquations {
 public:
  BiotEquations(Eigen::SparseMatrix<double> stiffness, PoreFlow flow, double unit_weight_of_water);

  /// tau [s]; 0: no water moves, and heads at faces are not given either. Throws std::runtime_error where
  /// rounding makes it impossible, as solve() does.
  void set(double tau);

  /// `load` f [N/m] and `water` W [m2]: u and h [m] at all nodes.
  void solve(const Eigen::VectorXd& load, const Eigen::VectorXd& water, Eigen::VectorXd& u,
             Eigen::VectorXd& h) const;

  const PoreFlow& flow() const { return flow_; }

 private:
  void number_heads();
  Eigen::VectorXd unbalanced(const Eigen::VectorXd& load, const Eigen::VectorXd& water,
                             const Eigen::VectorXd& u, const Eigen::VectorXd& h) const;

  Eigen::SparseMatrix<double> stiffness_;  ///< lower triangle
  PoreFlow flow_;
  double unit_weight_;
  std::optional<double> tau_;
  std::vector<int> unknown_;  ///< of each head; -1 where it is given
  Eigen::VectorXd scale_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors_;
};

}  // namespace porosph
