// Rows of a sparse matrix, and the Krylov methods that solve with it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace porosph {

/// Square; the diagonal is kept apart. Columns of a row in increasing order.
struct SparseRows {
  std::vector<std::int32_t> begin = {0};
  std::vector<std::int32_t> column;
  std::vector<double> value;
  std::vector<double> diagonal;

  std::size_t size() const { return diagonal.size(); }
  void multiply(std::span<const double> x, std::span<double> out) const;
};

struct KrylovResult {
  int iterations = 0;
  double residual = 0;  ///< norm of what is left over that at the start [-]
  bool converged = false;
};

/// Solves A x = b with A symmetric and positive definite, from the x that is given, until the residual is
/// `tolerance` of that at the start, or of b where that is asked for. Preconditioned with the diagonal. The
/// bits do not depend on the number of threads. Source: Saad, Iterative Methods for Sparse Linear Systems,
/// alg. 9.1.
enum class ToleranceOf { start, right_side };
KrylovResult conjugate_gradients(const SparseRows& a, std::span<const double> b, std::span<double> x,
                                 double tolerance, int most_iterations, ToleranceOf of = ToleranceOf::start);

/// The same where A is not symmetric: BiCGSTAB (Saad, alg. 7.7).
KrylovResult bicgstab(const SparseRows& a, std::span<const double> b, std::span<double> x, double tolerance,
                      int most_iterations);

}  // namespace porosph
