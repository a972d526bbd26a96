#include "app/bench/bench.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

#include "app/bench/plain_dynamics.hpp"
#include "solver/case/case_file.hpp"

namespace porosph::bench {

Bench::Bench(BenchOptions options) : options_(std::move(options)) {}

double Bench::seconds_left() const { return options_.seconds - (now() - start_).wall; }

void Bench::tell(const std::string& what) const {
  fmt::print(stderr, "{:4.0f} s  {}\n", options_.seconds - seconds_left(), what);
}

void Bench::leave_out(const std::string& what, const std::string& why) {
  left_out_.push_back(what + ": " + why);
  tell("left out: " + left_out_.back());
}

bool Bench::affords(const std::string& what, double seconds, double until) {
  const double left = seconds_left() - (1 - until) * options_.seconds;
  if (seconds <= left) return true;
  leave_out(what,
            fmt::format("would take about {:.3g} s where {:.3g} s are left", seconds, std::max(0.0, left)));
  return false;
}

Case read(const Bench& bench, const std::string& file, const std::vector<std::string>& overrides) {
  const std::filesystem::path path = bench.options().cases / file;
  if (!std::filesystem::exists(path))
    throw std::runtime_error(
        fmt::format("there is no {}: say with --cases where the cases are", path.string()));
  return read_case(path, overrides);
}

std::unique_ptr<Dynamics> make_plain_dynamics(const FormulationCase& formulation, Model& model) {
  return std::make_unique<PlainDynamics>(formulation, model);
}

}  // namespace porosph::bench
