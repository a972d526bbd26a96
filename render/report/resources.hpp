// Files that are built into the program (see cmake/PorosphEmbed.cmake).
#pragma once

#include <string_view>

namespace porosph::resources {

extern const std::string_view report_style;   ///< report.css
extern const std::string_view report_script;  ///< report.js

}  // namespace porosph::resources
