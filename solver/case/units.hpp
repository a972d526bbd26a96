// Physical units in the text of a case: "15 MPa", "20 kN/m3", "2 h".
#pragma once

#include <string>
#include <string_view>

namespace porosph {

/// A number that was written with its unit, in the unit asked for; or why it is none.
struct Measure {
  double value = 0;
  std::string fault;  ///< empty: none; else how the message continues after the key and its value
};

/// Reads `text`, a number and a unit of the dimension of `unit`, as a value in `unit` (a unit as in the
/// declarations of keys: "Pa", "N/m3", "degrees"; "" or "-": a pure number, which may be in %). Powers of ten
/// are applied to the digits: "20 kN/m3" is 20e3 to the last bit.
Measure read_measure(std::string_view text, std::string_view unit);

/// Whether text begins as a number does: it is then meant as a measure and not as a word.
bool begins_as_number(std::string_view text);

/// The usual units that measure what `unit` does: "Pa, kPa, MPa, GPa, kN/m2, psi, psf".
std::string usual_units(std::string_view unit);

/// The unit of the i-th number of a pair, as keys declare it: "s, m" or one for both.
std::string_view unit_of_component(std::string_view unit, int i);

}  // namespace porosph
