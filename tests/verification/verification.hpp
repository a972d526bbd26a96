// What the verification tests share: their cases, and the table of what they measured.
#pragma once

#include <string>
#include <vector>

#include "solver/case/case_file.hpp"
#include "solver/run/run.hpp"

namespace porosph::verification {

using Settings = std::vector<std::string>;  ///< overrides, "key=value"

/// cases/<name>.toml or cases/verification/<name>.toml.
Case scene(const std::string& name, const Settings& settings = {});

/// Runs to the end, which must not be an instability.
void run_to_end(Simulation& simulation, const RunWatch& watch = {});

/// Runs to the end. Mean reaction of the case's one footing over the last fifth of the time from `begin` [s]
/// on [N/m].
double mean_force_on_footing(Simulation& simulation, double begin);

/// One line of docs/verification.md.
struct Measurement {
  std::string name;  ///< of the case, as for scene()
  Settings settings;
  std::string quantity, reference, resolution;
  std::string order = {};  ///< of convergence, where it was fitted
  std::string subcommand = "run";
};

/// "0.12 %"
std::string percent(double fraction);
std::string scientific(double value);
std::string metres(double spacing);

/// Keeps a measured error for the table, and checks it. `text` turns error and limit into words.
void expect(const Measurement& what, double error, double largest_allowed,
            std::string (*text)(double) = percent);
/// Keeps a finding that is checked elsewhere.
void note(const Measurement& what, const std::string& found, const std::string& allowed = "");

/// The coarse spacing, and the fine one too where the tests may take long: `./test.sh --nightly`, and where
/// the table is written [m].
std::vector<double> coarse_and_fine(double coarse, double fine);

/// Exponent p of error ~ spacing^p, fitted by least squares to the logarithms.
double fitted_order(const std::vector<double>& spacings, const std::vector<double>& errors);

}  // namespace porosph::verification
