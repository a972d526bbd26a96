#include "solver/soil/soil.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

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
bool yields(const LinearElastic&) { return false; }
bool yields(const std::shared_ptr<const ExternalLaw>&) { return true; }

template <SoilLaw Law>
typename Law::History history_of(const Particles& p, const std::vector<std::size_t>& places, std::size_t a) {
  typename Law::History q;
  static_assert(sizeof q == Law::history.size() * sizeof(double));
  for (std::size_t k = 0; k < places.size(); ++k)
    std::memcpy(reinterpret_cast<char*>(&q) + k * sizeof(double), &p.history[places[k]].values[a],
                sizeof(double));
  return q;
}

/// Share of the shear strength that a state needs.
template <YieldingLaw Law>
double mobilised(const Law& law, const Stress& stress, const typename Law::History& q) {
  const double strength = law.shear_strength(stress, q), needed = law.shear_stress(stress);
  return needed < strength ? needed / strength : 1;
}

/// Calls use(law, history) where the law has a limited shear strength; 0 elsewhere.
template <class Use>
double of_yielding(const AnyLaw& any, const Particles& p, const std::vector<std::size_t>& places,
                   std::size_t a, Use&& use) {
  return std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (YieldingLaw<Law>)
          return use(law, history_of<Law>(p, places, a));
        else
          return 0.0;
      },
      any);
}

}  // namespace

const Elasticity& Soil::elastic() const {
  return std::visit([](const auto& law) -> const Elasticity& { return elastic_part(law); }, law_);
}

bool Soil::stiffness_varies() const {
  return std::visit(
      []<class Law>(const Law&) {
        return requires { Law::stiffness_varies; };
      },
      law_);
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

void Soil::start_history(Particles& p, std::int32_t soil) const {
  std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (
            requires { law.at_start(Vec2()); } || requires { law.at_start(Vec2(), Stress()); })
          for (std::size_t a = 0; a < p.size(); ++a) {
            if (p.soil[a] != soil) continue;
            const typename Law::History q = history_at_start(law, p.position[a], p.stress[a]);
            for (std::size_t k = 0; k < history_.size(); ++k)
              std::memcpy(&p.history[history_[k]].values[a],
                          reinterpret_cast<const char*>(&q) + k * sizeof(double), sizeof(double));
          }
      },
      law_);
}

double Soil::mobilised_strength(const Particles& p, std::size_t a) const {
  return of_yielding(law_, p, history_, a,
                     [&](const auto& law, const auto& q) { return mobilised(law, p.stress[a], q); });
}

double Soil::cohesion(const Particles& p, std::size_t a) const {
  return of_yielding(law_, p, history_, a, [](const auto& law, const auto& q) {
    return std::max(0.0, law.shear_strength(Stress{}, q));
  });
}

double Soil::sin_friction(const Particles& p, std::size_t a) const {
  return of_yielding(law_, p, history_, a,
                     [](const auto& law, const auto& q) { return law.sin_friction(q); });
}

double Soil::plastic_dilation(const Particles& p, std::size_t a) const {
  return of_yielding(law_, p, history_, a, [&](const auto& law, const auto& q) {
    if constexpr (requires { q.dilation; })
      return q.dilation;
    else if constexpr (requires { law.plastic_dilation(p.stress[a], q); })
      return law.plastic_dilation(p.stress[a], q);
    else
      return 0.0;
  });
}

double Soil::stiffness(const Particles& p, std::size_t a) const {
  return std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (YieldingLaw<Law>)
          return law.constrained_modulus(p.stress[a], history_of<Law>(p, history_, a));
        else
          return elastic_part(law).constrained_modulus();
      },
      law_);
}

double Soil::mobilised_friction(const Particles& p, std::size_t a) const {
  return of_yielding(law_, p, history_, a, [&](const auto& law, const auto& q) {
    return std::asin(law.sin_friction(q) * mobilised(law, p.stress[a], q)) * 180 / std::numbers::pi;
  });
}

}  // namespace porosph
