// The soil laws that the program is built with.
#pragma once

#include <memory>
#include <variant>

#include "solver/soil/byrne.hpp"
#include "solver/soil/cam_clay.hpp"
#include "solver/soil/drucker_prager.hpp"
#include "solver/soil/external_law.hpp"
#include "solver/soil/linear_elastic.hpp"
#include "solver/soil/mohr_coulomb.hpp"
#include "solver/soil/no_tension.hpp"
#include "solver/soil/tresca.hpp"

namespace porosph {

template <SoilLaw... Law>
struct LawList {
  using Any = std::variant<Law..., std::shared_ptr<const ExternalLaw>>;
  static constexpr std::size_t size = sizeof...(Law);
};

/// A law's place in this list is its number in the kernels; one of a program's own comes last.
using Laws = LawList<LinearElastic, DruckerPrager, MohrCoulomb, Tresca, NoTension, CamClay, Byrne>;
using AnyLaw = Laws::Any;

}  // namespace porosph
