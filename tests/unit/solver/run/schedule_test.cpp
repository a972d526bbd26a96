#include <catch2/catch.hpp>
#include <cmath>

#include "solver/run/run.hpp"

using namespace porosph;

namespace {

std::vector<std::int64_t> due_steps(const Schedule& schedule, std::int64_t last) {
  std::vector<std::int64_t> steps;
  for (std::int64_t s = 0; s <= last; ++s)
    if (schedule.due(s)) steps.push_back(s);
  return steps;
}

using Steps = std::vector<std::int64_t>;

}  // namespace

TEST_CASE("without an interval the first and the last step are due", "[simulation]") {
  CHECK(due_steps(Schedule(0, 0.01, 37), 37) == Steps{0, 37});
}

TEST_CASE("an interval of whole steps comes out even", "[simulation]") {
  CHECK(due_steps(Schedule(0.1, 0.01, 35), 35) == Steps{0, 10, 20, 30, 35});
}

TEST_CASE("an interval of broken steps takes the nearest ones", "[simulation]") {
  CHECK(due_steps(Schedule(0.26, 0.1, 11), 11) == Steps{0, 3, 5, 8, 10, 11});
  const double dt = 0.00731, interval = 0.1;
  const Steps steps = due_steps(Schedule(interval, dt, 10000), 10000);
  CHECK(steps.size() == std::size_t(10000 * dt / interval) + 2);  // the last one besides
  for (std::size_t i = 0; i + 1 < steps.size(); ++i)
    CHECK(std::abs(static_cast<double>(steps[i]) * dt - static_cast<double>(i) * interval) <= 0.5001 * dt);
}

TEST_CASE("an interval shorter than a step makes every step due", "[simulation]") {
  CHECK(due_steps(Schedule(0.003, 0.01, 5), 5) == Steps{0, 1, 2, 3, 4, 5});
  CHECK(due_steps(Schedule(0.01, 0.01, 3), 3) == Steps{0, 1, 2, 3});
  CHECK(due_steps(Schedule(0.013, 0.01, 4), 4) == Steps{0, 1, 3, 4});
}
