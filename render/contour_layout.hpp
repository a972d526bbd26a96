// Where the panels and colour bars of a contour figure go.
#pragma once

#include <vector>

#include "render/axes.hpp"

namespace porosph::render {

struct ContourSpace {
  double world_width = 1, world_height = 1;  ///< that each panel shows [m]
  FrameMargins margins;                      ///< around each panel's frame, titles included [pixels]
  double padding = 0;                        ///< between the world and the frame [pixels]
  double least_frame = 0;                    ///< wanted width of a frame, for its titles [pixels]
  double header = 0;                         ///< above all panels [pixels]
  double bar_slot = 0;                       ///< width of a colour bar with its labels [pixels]
  std::vector<bool> own_scale;               ///< one per panel
};

struct ContourSize {
  int columns = 0, width = 0, height = 0;  ///< 0: to be found
  double least_width = 0;                  ///< of a fitted figure [pixels]
};

struct BarPlace {
  Box box;
  int panel;  ///< whose scale it shows
};

struct ContourLayout {
  int width = 0, height = 0;
  double pixels_per_metre = 0;
  std::vector<Box> frames;  ///< one per panel, equal in size, on whole pixels
  std::vector<BarPlace> bars;
};

/// The largest equal panels that fit, one colour bar beside each panel with its own scale and one for each
/// block of panels that share theirs. Throws std::runtime_error if the picture is too small.
ContourLayout lay_out(const ContourSpace& space, const ContourSize& size);

}  // namespace porosph::render
