// particles.pvd: ParaView's list of the files of a time series.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace porosph {

struct SeriesFrame {
  double time = 0;                 ///< [s]
  std::string file;                ///< relative to the folder of the .pvd, with '/'
  std::string boundary_file = {};  ///< of a second block, likewise; empty where there is none
};

/// The text of the .pvd: times to 17 digits' worth, so that reading gives the same doubles.
std::string pvd_text(const std::vector<SeriesFrame>& frames);

/// The frames in the order of the file; a data set of part 1 belongs to the frame before it. Names may not
/// lead outside its folder, times may not decrease. Throws ReadError.
std::vector<SeriesFrame> read_pvd(const std::filesystem::path& file);

}  // namespace porosph
