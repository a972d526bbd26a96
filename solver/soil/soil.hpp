// A soil of the model: its law, and where the law's history lies among the fields of the particles.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/particles/particles.hpp"
#include "solver/soil/laws.hpp"

namespace porosph {

class Soil {
 public:
  /// `flows`: the soil may deform without end, which the motion equation takes care of. `id`: its number in
  /// the case file.
  explicit Soil(AnyLaw law, bool flows = false, std::int32_t id = 0)
      : law_(std::move(law)), flows_(flows), id_(id) {}

  const AnyLaw& law() const { return law_; }
  const Elasticity& elastic() const;
  bool may_yield() const;  ///< false: its step is always elastic
  bool flows() const { return flows_; }
  std::int32_t id() const { return id_; }
  double shear_modulus() const { return elastic().shear_modulus; }                              ///< G [Pa]
  double bulk_modulus() const { return elastic().bulk_modulus; }                                ///< K [Pa]
  double constrained_modulus() const { return elastic().constrained_modulus(); }                ///< M [Pa]
  double stored_energy(const Stress& stress) const { return elastic().stored_energy(stress); }  ///< [J/m3]

  /// Gives the particles the fields that the law remembers, 0 where they are new. A field of one name is
  /// shared by all soils that have it.
  void add_history(Particles& particles);
  /// What the law remembers of this soil's particles at t = 0, `soil` being their number for it.
  void start_history(Particles& particles, std::int32_t soil) const;

  /// Shear stress of a particle over the most that the law bears at its mean stress, at most 1; 0 in soil
  /// that bears any.
  double mobilised_strength(const Particles& particles, std::size_t a) const;
  /// What the particle's law bears of shear without mean stress [Pa], and the sine of its friction angle; 0
  /// in soil that does not yield.
  double cohesion(const Particles& particles, std::size_t a) const;
  double sin_friction(const Particles& particles, std::size_t a) const;
  /// Modulus M of one-dimensional compression of a particle now [Pa].
  double stiffness(const Particles& particles, std::size_t a) const;
  /// The law's stiffness follows its state: its energy is not that of the largest moduli.
  bool stiffness_varies() const;
  /// Volume strain without what has opened, beyond that of elastic soil with the law's largest moduli.
  double plastic_dilation(const Particles& particles, std::size_t a) const;
  /// Friction angle at which the particle's stress would be on the yield surface, where the cone's apex stays
  /// where it is [degrees]; 0 in soil without friction.
  double mobilised_friction(const Particles& particles, std::size_t a) const;
  /// Places of the law's history in Particles::history.
  const std::vector<std::size_t>& history() const { return history_; }

 private:
  AnyLaw law_;
  bool flows_;
  std::int32_t id_;
  std::vector<std::size_t> history_;
};

}  // namespace porosph
