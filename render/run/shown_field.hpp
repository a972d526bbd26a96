// Which number of the particle data a picture shows, and how people read it.
#pragma once

#include <string>
#include <vector>

#include "render/colour_map.hpp"
#include "solver/analysis/frame_values.hpp"

namespace porosph::render {

/// A text as the name of a file in a folder: '_' takes the place of all but letters a to z, digits, '-' and
/// '_', so that names that come from files never lead elsewhere.
std::string file_name(const std::string& text);

/// The unit that people read, and what to multiply the file's values with.
struct ShownUnit {
  std::string name;  ///< empty: none
  double factor = 1;
};

/// Stress and pressure in kPa; lengths in mm where `largest` (SI, absolute) is below 0.2 m; else as in the
/// file.
ShownUnit shown_unit(const std::string& field, double largest);

/// The usual symbol and the unit, subscripts as Canvas draws them: "σ'_{yy} [kPa]"; the field's own name
/// where it is not one of ours.
std::string shown_label(const FieldSelection& selection, const ShownUnit& unit);

/// In words: "Effective vertical stress"; the field's own name where it is not one of ours.
std::string shown_name(const FieldSelection& selection);

/// As it stands within a sentence: "effective vertical stress".
std::string name_in_sentence(const FieldSelection& selection);

/// Diverging for what is zero at rest and has either sign (shear, sideways motion), else sequential.
ColourMap usual_map(const FieldSelection& selection);

/// Whether the colours are usually logarithmic: of strain that localises in bands, over some decades.
bool usually_logarithmic(const FieldSelection& selection);

/// Every value times `factor`.
std::vector<double> scaled(std::vector<double> values, double factor);

}  // namespace porosph::render
