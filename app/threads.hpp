// How many threads compute.
#pragma once

#include <boost/program_options/options_description.hpp>
#include <cstddef>
#include <string>

namespace porosph::app {

/// As many as `wanted`, or with 0 as many cores as so many particles keep busy.
void use_threads(int wanted, std::size_t particles);

/// Adds --jobs, by default `usual`, or with 0 one for each core. `what`: "runs at a time".
void add_jobs(boost::program_options::options_description& options, int& jobs, const std::string& what,
              int usual = 0);
/// Throws UsageError where the number is out of range.
void check_jobs(int jobs);

}  // namespace porosph::app
