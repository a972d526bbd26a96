#include "app/import/case_of_ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/import/drawn_water.hpp"
#include "solver/case/shapes.hpp"
#include "solver/case/toml_text.hpp"

namespace porosph::drawn {
namespace {

constexpr double usual_particles = 2500, rows_of_a_soil = 2;
constexpr const char* fill_in = "FILL IN";

// Usual values of a soil that nothing is known of.
constexpr double youngs_modulus = 20e6, poissons_ratio = 0.3, saturated_weight = 20e3;

/// The largest of 1, 2, 2.5 and 5 times a power of ten that is not above x.
double round_number_below(double x) {
  const double decade = std::pow(10, std::floor(std::log10(x)));
  for (const double digit : {5.0, 2.5, 2.0})
    if (digit * decade <= x * (1 + 1e-9)) return digit * decade;
  return decade;
}

/// 0.1 + 0.2 as 0.3: coordinates to the tenth of a micrometre.
std::string number(double x) { return toml_text(std::round(x * 1e7) / 1e7 + 0.0); }
std::string number(const Point& p) { return fmt::format("[{}, {}]", number(p.x()), number(p.y())); }
std::string polygon(const Polygon& ring) {
  std::string text;
  for (const Point& p : ring) text += (text.empty() ? "" : ", ") + number(p);
  return "[" + text + "]";
}

/// Long enough for the slowest vibration, about 4 H / c_s, to die down forty times over [s].
double time_to_rest(const Box& box) {
  const double shear_modulus = youngs_modulus / (2 * (1 + poissons_ratio));
  const double wave_speed = std::sqrt(shear_modulus / (saturated_weight / 9.81));
  return std::ceil(40 * 4 * (box.high.y() - box.low.y()) / wave_speed);
}

std::string soil_text(const SoilCase& soil, bool water_flows) {
  std::string text =
      fmt::format("\n[[soil]]\nname = \"{}\"\npolygon = {}\n", soil.name, polygon(soil.polygon));
  if (!soil.holes.empty()) {
    std::string holes;
    for (const Polygon& hole : soil.holes) holes += (holes.empty() ? "" : ", ") + polygon(hole);
    text += fmt::format("holes = [{}]\n", holes);
  }
  const auto line = [&](std::string_view setting, std::string_view meaning) {
    text += fmt::format("{:36} # {}: {}\n", setting, fill_in, meaning);
  };
  line("youngs_modulus = \"20 MPa\"", "drained");
  line("poissons_ratio = 0.3", "drained");
  line("unit_weight_saturated = \"20 kN/m3\"", "below water");
  line("unit_weight_unsaturated = \"18 kN/m3\"", "above water");
  if (water_flows) line("permeability = \"1e-6 m/s\"", "saturated");
  line("law = \"mohr_coulomb\"", "or elastic, drucker_prager, tresca");
  line("cohesion = \"5 kPa\"", "effective");
  line("friction_angle = \"30 deg\"", "effective");
  return text;
}

std::string face_text(const Stretch& stretch, std::optional<double> level) {
  std::string text = fmt::format("\n[[water.face]]\nkind = \"{}\"\n", level ? "head" : "seepage");
  if (level) text += fmt::format("level = {}\n", number(*level));
  return text + fmt::format("from = {}\nto = {}\n", number(stretch.from), number(stretch.to));
}

std::string water_text(const Ground& ground) {
  if (!has_water(ground)) return "";
  if (stands_still(ground)) return fmt::format("\n[water]\nlevel = {}\n", number(ground.water[0].level));
  std::string text =
      "\n[water]\nmode = \"steady\"   # between the levels that were drawn\n\n"
      "[[water.face]]    # base and ends: nothing passes where no later face says otherwise\n"
      "kind = \"closed\"\n";
  for (const Stretch& stretch : ground.outline) {
    if (const EndLevel* end = end_level(stretch, ground)) text += face_text(stretch, end->level);
    if (stretch.side != Side::surface) continue;
    const WaterLine* water = water_beside(stretch, ground.water);
    text += face_text(stretch, water != nullptr ? std::optional(water->level) : std::nullopt);
  }
  return text;
}

std::string support_text(BoundaryKind kind, const Point& from, const Point& to) {
  return fmt::format("\n[[boundary]]\nkind = \"{}\"\nfrom = {}\nto = {}\n",
                     kind == BoundaryKind::roller ? "roller" : "fixed", number(from), number(to));
}

std::string supports_text(const Ground& ground) {
  std::string text;
  for (const BoundaryCase& drawn : ground.supports) text += support_text(drawn.kind, drawn.from, drawn.to);
  if (!ground.supports.empty()) return text;
  for (const Stretch& s : ground.outline)
    if (s.side != Side::surface)
      text += support_text(s.side == Side::flank ? BoundaryKind::roller : BoundaryKind::fixed, s.from, s.to);
  return text;
}

}  // namespace

double usual_spacing(const Ground& ground) {
  double whole = 0, thinnest = never;
  for (const SoilCase& soil : ground.soils) {
    whole += area(soil);
    thinnest = std::min(thinnest, thickness(soil.polygon));
  }
  return round_number_below(std::min(std::sqrt(whole / usual_particles), thinnest / rows_of_a_soil));
}

std::string case_of_ground(const Ground& ground, double spacing, const std::string& title,
                           const std::string& source) {
  const Box box = box_of(ground);
  const bool water_flows = has_water(ground) && !stands_still(ground);
  std::string text = fmt::format(
      "# Imported from {}. Lines marked {} hold usual values that no drawing knows:\n"
      "# give those of your soils. Numbers are in SI units; text may carry other ones.\n"
      "title = {}\n\n[particles]\nspacing = {}\n",
      source, fill_in, toml_text(title), number(spacing));
  for (const SoilCase& soil : ground.soils) text += soil_text(soil, water_flows);
  text += water_text(ground) + supports_text(ground);
  text += fmt::format(
      "\n[loading]\ndamping = \"adaptive\"\n\n[time]\nend = {}   # seconds; at rest it ends by "
      "itself\ncourant = "
      "0.6\n\n[stop]\nunbalanced_force_ratio = 1e-4\n",
      number(time_to_rest(box)));
  for (const ProbeCase& probe : ground.probes)
    text += fmt::format("\n[[probe]]\nname = \"{}\"\nposition = {}\n", probe.name, number(probe.position));
  return text;
}

}  // namespace porosph::drawn
