// How much of a soil is pores.
#pragma once

#include "solver/case/case.hpp"

namespace porosph {

constexpr double usual_porosity = 0.4;  // where the case gives none

inline double porosity_of(const SoilCase& soil) { return soil.porosity > 0 ? soil.porosity : usual_porosity; }

}  // namespace porosph
