#include "solver/sweep/run_sweep.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "solver/case/case_file.hpp"
#include "solver/case/stages.hpp"

namespace porosph {
namespace {

/// FNV-1a (Fowler, Noll, Vo), 64 bits: the same on every machine.
std::string hash(const std::string& text) {
  std::uint64_t h = 14695981039346656037u;
  for (const unsigned char c : text) h = (h ^ c) * 1099511628211u;
  return fmt::format("{:016x}", h);
}

std::string fingerprint_of(const Sweep& sweep, const std::string& complete_case) {
  return hash(fmt::format("{}\n{} {} {}", complete_case, static_cast<int>(sweep.reference),
                          sweep.limits.accurate, sweep.limits.settled));
}

Verdict refusal(const std::string& message) {
  Verdict v;
  v.error = v.unbalanced = v.energy_growth = std::nan("");
  v.message = message;
  return v;
}

class SweepRun {
 public:
  SweepRun(const Sweep& sweep, const MeasureMaker& measure, const SweepWatch& watch)
      : sweep_(sweep), measure_(measure), watch_(watch), verdicts_(sweep.size()) {}

  std::vector<std::optional<Verdict>> all(int jobs) {
    std::vector<std::thread> workers;
    for (int i = 0; i < jobs; ++i) workers.emplace_back([this] { work(); });
    for (std::thread& worker : workers) worker.join();
    if (failure_) std::rethrow_exception(failure_);
    return std::move(verdicts_);
  }

 private:
  bool stopped() const { return failed_ || (watch_.interrupted && watch_.interrupted()); }

  void work() {
    omp_set_num_threads(1);  // of this worker only
    try {
      for (std::size_t i = next_++; i < sweep_.size() && !stopped(); i = next_++) compute(i);
    } catch (...) {  // what the watch throws: a file that cannot be written
      const std::scoped_lock lock(mutex_);
      failure_ = std::current_exception();
      failed_ = true;
    }
  }

  void compute(std::size_t i) {
    std::string complete;
    Verdict verdict;
    try {
      const Case scene = read_case(sweep_.case_file, sweep_.settings_of(i));
      complete = write_case(scene);
      if (recall(i, complete)) return;
      verdict = judge(scene, sweep_.limits, measure_, [this] { return stopped(); });
    } catch (const std::runtime_error& error) {  // a case, a reference or a mesh that cannot be
      verdict = refusal(error.what());
    }
    if (stopped()) return;
    const std::scoped_lock lock(mutex_);
    verdicts_[i] = verdict;
    if (watch_.finished) watch_.finished(i, fingerprint_of(sweep_, complete), verdict);
  }

  bool recall(std::size_t i, const std::string& complete) {
    if (!watch_.known) return false;
    const std::scoped_lock lock(mutex_);
    verdicts_[i] = watch_.known(i, fingerprint_of(sweep_, complete));
    return verdicts_[i].has_value();
  }

  const Sweep& sweep_;
  const MeasureMaker& measure_;
  const SweepWatch& watch_;
  std::vector<std::optional<Verdict>> verdicts_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
  std::exception_ptr failure_;
  std::mutex mutex_;
};

}  // namespace

std::vector<std::optional<Verdict>> run_sweep(const Sweep& sweep, const MeasureMaker& measure, int jobs,
                                              const SweepWatch& watch) {
  require_plain(read_case(sweep.case_file, sweep.settings),
                "a sweep");  // what is wrong without any axis is wrong everywhere
  return SweepRun(sweep, measure, watch).all(std::max(1, jobs));
}

std::vector<bool> usual_values(const Sweep& sweep, const SweepAxis& axis) {
  const std::string base = write_case(read_case(sweep.case_file, sweep.settings));
  std::vector<bool> usual;
  for (const SweepValue& value : axis.values) {
    std::vector<std::string> settings = sweep.settings;
    settings.insert(settings.end(), value.settings.begin(), value.settings.end());
    try {
      usual.push_back(!value.settings.empty() && write_case(read_case(sweep.case_file, settings)) == base);
    } catch (const CaseError&) {
      usual.push_back(false);
    }
  }
  return usual;
}

}  // namespace porosph
