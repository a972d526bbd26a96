// A soil of the model: its law, and where the law's history lies among the fields of the particles.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/particles/particles.hpp"
#include "solver/soil/laws.hpp"

namespace porosph {

class Soil {
 public:
  explicit Soil(AnyLaw law) : law_(std::move(law)) {}

  const AnyLaw& law() const { return law_; }
  const Elasticity& elastic() const;
  bool may_yield() const;                                           ///< false: its step is always elastic
  double shear_modulus() const { return elastic().shear_modulus; }  ///< G [Pa]
  double bulk_modulus() const { return elastic().bulk_modulus; }    ///< K [Pa]
  double constrained_modulus() const { return elastic().constrained_modulus(); }                ///< M [Pa]
  double stored_energy(const Stress& stress) const { return elastic().stored_energy(stress); }  ///< [J/m3]

  /// Gives the particles the fields that the law remembers, 0 where they are new. A field of one name is
  /// shared by all soils that have it.
  void add_history(Particles& particles);
  /// Places of the law's history in Particles::history.
  const std::vector<std::size_t>& history() const { return history_; }

 private:
  AnyLaw law_;
  std::vector<std::size_t> history_;
};

}  // namespace porosph
