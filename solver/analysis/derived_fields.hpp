// Fields that are computed from those of a frame when it is looked at, without running the case again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/output/frame.hpp"
#include "solver/particles/field.hpp"

namespace porosph {

/// Those that runs do not write; field_table() has the others. Values that have no meaning (the friction of
/// soil in tension) are not numbers.
const std::vector<Field>& derived_field_table();

/// The field of this name in field_table() or derived_field_table(), or null.
const Field* find_shown_field(const std::string& name);

/// Computes a field from those that the frame has. Empty for a field that is not computed, or not from these.
std::optional<FrameField> derived_field(const Frame& frame, const std::string& name);

/// Names of the fields that the frame does not have and that can be computed from it.
std::vector<std::string> derivable_fields(const Frame& frame);

/// "EffectiveStress and PorePressure": what a field is computed from; empty for a field that is not computed.
std::string sources_of_field(const std::string& name);

/// Adds the head y - p_w / gamma_w [m] where the frame has the pore pressure and no head of its own. Takes
/// the unit weight of water [N/m3].
void add_head(Frame& frame, double water_unit_weight);

}  // namespace porosph
