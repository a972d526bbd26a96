#include "solver/reference/exact/root.hpp"

#include <boost/math/tools/toms748_solve.hpp>

namespace porosph {

double find_root(const std::function<double(double)>& f, double low, double high) {
  boost::uintmax_t iterations = 200;
  const auto [left, right] = boost::math::tools::toms748_solve(
      f, low, high, boost::math::tools::eps_tolerance<double>(51), iterations);
  return left + (right - left) / 2;
}

}  // namespace porosph
