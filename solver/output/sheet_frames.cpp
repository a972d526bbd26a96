#include "solver/output/sheet_frames.hpp"

namespace porosph {

std::vector<SheetFrame> make_sheet_frames(Simulation& s) {
  std::vector<SheetFrame> frames;
  if (!s.sheets().empty()) s.accelerations();  // for the forces at this instant
  for (const Sheet& sheet : s.sheets()) {
    const Sheet::Profile profile = sheet.profile();
    SheetFrame& frame = frames.emplace_back();
    frame.name = sheet.name();
    for (std::size_t i = 0; i < profile.drawn.size(); ++i) {
      const Vec2 at = profile.drawn[i] + s.model().origin;
      frame.nodes.push_back({.x = at.x(),
                             .y = at.y(),
                             .u_x = profile.moved[i].x(),
                             .u_y = profile.moved[i].y(),
                             .axial = profile.sections[i].axial,
                             .shear = profile.sections[i].shear,
                             .moment = profile.sections[i].moment});
    }
  }
  return frames;
}

std::map<std::string, Summary::Sheet> sheet_readings(Simulation& s) {
  std::map<std::string, Summary::Sheet> readings;
  if (!s.sheets().empty()) s.accelerations();
  for (const Sheet& sheet : s.sheets()) {
    const Sheet::Extremes most = extremes_of(sheet.profile());
    readings[sheet.name()] = {.moment = most.section.moment,
                              .shear = most.section.shear,
                              .axial = most.section.axial,
                              .displacement = most.displacement};
  }
  return readings;
}

}  // namespace porosph
