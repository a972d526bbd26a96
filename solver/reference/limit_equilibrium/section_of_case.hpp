// A case's section for limit equilibrium.
#pragma once

#include "solver/case/case.hpp"
#include "solver/reference/limit_equilibrium/section.hpp"

namespace porosph::limit_equilibrium {

/// Soils with the strength of their law, elastic ones without: nothing slides through them. Water and loads
/// as they stand at the case's end.
Section section_of(const Case& scene);

}  // namespace porosph::limit_equilibrium
