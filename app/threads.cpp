#include "app/threads.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <thread>

#include "app/command.hpp"

namespace porosph::app {
namespace {

/// More threads than this would wait for each other.
int useful_threads(std::size_t particles) {
  constexpr std::size_t particles_per_thread = 4000;
  return std::clamp(static_cast<int>(particles / particles_per_thread), 1, omp_get_num_procs());
}

}  // namespace

void use_threads(int wanted, std::size_t particles) {
  omp_set_num_threads(wanted > 0 ? wanted : useful_threads(particles));
}

void add_jobs(boost::program_options::options_description& options, int& jobs, const std::string& what,
              int usual) {
  if (usual == 0) usual = static_cast<int>(std::thread::hardware_concurrency());
  options.add_options()("jobs", boost::program_options::value(&jobs)->value_name("N")->default_value(usual),
                        (what + ", each on one core").c_str());
}

void check_jobs(int jobs) {
  if (jobs < 1 || jobs > 1024) throw UsageError(fmt::format("--jobs = {}: must be from 1 to 1024", jobs));
}

}  // namespace porosph::app
