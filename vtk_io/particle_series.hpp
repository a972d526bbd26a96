// A run's particles as files that ParaView opens: particles.pvd and frames/particles_NNNNNN.vtp; and its
// sheets.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/output/frame.hpp"
#include "vtk_io/paraview_script.hpp"
#include "vtk_io/pvd.hpp"

namespace porosph {

/// The file of the sheets beside a frame's particles.
std::string sheets_file(const SeriesFrame& frame);

struct SeriesOptions {
  FrameFormat format = FrameFormat::poly_data;
  Compression compression = Compression::zlib;
  FramePrecision precision = FramePrecision::full;
  ScriptScene scene = {};      ///< for the scripts beside the series
  std::string case_text = {};  ///< kept in each frame, so that it says what it is of
};

/// Writes the frames of one run. After each the .pvd names all of them, so that a running or killed job
/// opens; frames of an earlier series in the folder that it does not name are removed. Beside them stands
/// open_in_paraview.py, which shows the series coloured, and compare_in_paraview.py, which shows it beside
/// another. Every file is complete or not there. All members
/// throw WriteError.
class SeriesWriter {
 public:
  /// Makes `folder` where there is none.
  explicit SeriesWriter(std::filesystem::path folder, SeriesOptions options = {});

  /// Continues the series in `folder` after its frame at `time` [s]; later ones are removed. Throws ReadError
  /// if its .pvd cannot be read or names no such frame, or if the files up to it have other checksums than
  /// these.
  static SeriesWriter resume(std::filesystem::path folder, double time, std::vector<std::uint32_t> checksums,
                             SeriesOptions options = {});

  /// Adds a frame, with the particles behind the walls as a second block where they are given. Throws
  /// std::invalid_argument if it is not consistent or earlier than the last.
  void write(const Frame& frame, const std::optional<Frame>& boundary = {});
  /// Adds the sheets at the last frame, to a series of their own: sheets.pvd. Each frame has them, or none.
  void write_sheets(const std::vector<SheetFrame>& sheets);

  const std::vector<SeriesFrame>& frames() const { return frames_; }  ///< written so far
  std::filesystem::path pvd() const;
  /// Of each file of the frames, in order; a frame's boundary after its particles.
  const std::vector<std::uint32_t>& checksums() const { return checksums_; }

 private:
  void check_files(const std::vector<std::uint32_t>& checksums) const;
  void write_pvd() const;
  void write_sheets_pvd() const;
  void remove_unnamed_frames() const;
  std::filesystem::path folder_;
  SeriesOptions options_;
  std::vector<SeriesFrame> frames_;
  std::vector<std::uint32_t> checksums_;
};

}  // namespace porosph
