#include "solver/soil/soil.hpp"

#include <algorithm>

namespace porosph {
namespace {

const Elasticity& elastic_part(const Elasticity& law) { return law; }
const Elasticity& elastic_part(const std::shared_ptr<const ExternalLaw>& law) { return law->elastic(); }

template <SoilLaw Law>
std::vector<Field> history_fields(const Law&) {
  return {Law::history.begin(), Law::history.end()};
}
std::vector<Field> history_fields(const std::shared_ptr<const ExternalLaw>& law) { return law->history(); }

template <SoilLaw Law>
bool yields(const Law&) {
  return true;
}
bool yields(const LinearElastic& law) { return law.no_tension; }
bool yields(const std::shared_ptr<const ExternalLaw>&) { return true; }

}  // namespace

const Elasticity& Soil::elastic() const {
  return std::visit([](const auto& law) -> const Elasticity& { return elastic_part(law); }, law_);
}

bool Soil::may_yield() const {
  return std::visit([](const auto& law) { return yields(law); }, law_);
}

void Soil::add_history(Particles& particles) {
  history_.clear();
  for (const Field& field : std::visit([](const auto& law) { return history_fields(law); }, law_)) {
    auto& all = particles.history;
    const auto found =
        std::ranges::find_if(all, [&](const HistoryField& h) { return h.field.name == field.name; });
    history_.push_back(static_cast<std::size_t>(found - all.begin()));
    if (found == all.end()) all.push_back({field, std::vector<double>(particles.size(), 0.0)});
  }
}

}  // namespace porosph
