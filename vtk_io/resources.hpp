// Files that are built into the program (see cmake/PorosphEmbed.cmake).
#pragma once

#include <string_view>

namespace porosph::resources {

extern const std::string_view paraview_common;   ///< paraview/porosph_common.py
extern const std::string_view paraview_open;     ///< paraview/open_in_paraview.py
extern const std::string_view paraview_compare;  ///< paraview/compare_in_paraview.py

}  // namespace porosph::resources
