#include "render/report/fem_check_section.hpp"

#include <fmt/format.h>

#include <cmath>

#include "render/report/html.hpp"
#include "render/run/shown_field.hpp"
#include "solver/space/place_text.hpp"

namespace porosph::render {
namespace {

std::string percent(double part) { return std::isfinite(part) ? fmt::format("{:.2g} %", 100 * part) : "–"; }

std::string table_of(const FemCheck& check) {
  std::vector<std::vector<std::string>> rows = {
      {"Soil", "Field", "Relative L2", "Of the field", "Worst patch", "Around [m]", "At most", "At [m]"}};
  for (const auto& [name, soil] : check.soils)
    for (const auto& [field, d] : soil.fields) {
      const auto underscore = field.find('_');
      const FieldSelection selection{field.substr(0, underscore), field.substr(underscore + 1)};
      const ShownUnit unit = shown_unit(selection.name, d.max_abs);
      rows.push_back({name, shown_label(selection, {}), percent(d.relative_l2), percent(d.relative),
                      percent(d.local), place_text({d.local_x, d.local_y}),
                      fmt::format("{:.3g} {}", d.max_abs * unit.factor, unit.name), place_text({d.x, d.y})});
    }
  return html::table(rows);
}

}  // namespace

std::string fem_check_section(const std::vector<std::string>& labels, const std::vector<Summary>& summaries) {
  std::string text;
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const auto& check = summaries[i].finite_elements;
    if (!check) continue;
    if (!check->skipped.empty()) {
      text += html::paragraph(labels[i] + " was not compared: " + check->skipped + ".");
      continue;
    }
    text += html::paragraph(fmt::format(
        "{}: {:.0f} unknowns, {:.2g} s. Finite elements of small strain, solved by the run itself, at the "
        "particles; places near corners where stress is singular are left out. A difference of more than "
        "{:.2g} % "
        "of a component (or of a fifth of its field, where that is larger) is a warning, and so is {:.2g} % "
        "in a patch "
        "of four by four spacings (of the patch's own values, or of the weight of soil as high as it).",
        labels[i], check->unknowns, check->seconds, 100 * check->limit, 100 * check->local_limit));
    text += table_of(*check);
  }
  return text.empty() ? text : html::section("Checked by finite elements", text);
}

}  // namespace porosph::render
