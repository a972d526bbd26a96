// A run's particles as files that ParaView opens: particles.pvd and frames/particles_NNNNNN.vtp.
#pragma once

#include <filesystem>
#include <vector>

#include "solver/output/frame.hpp"
#include "vtk_io/pvd.hpp"

namespace porosph {

enum class FrameFormat {
  poly_data,          ///< .vtp
  unstructured_grid,  ///< .vtu
};
enum class Compression { none, lz4, zlib };

struct SeriesOptions {
  FrameFormat format = FrameFormat::poly_data;
  Compression compression = Compression::zlib;
};

/// Writes the frames of one run. After each the .pvd names all of them, so that a running or killed job
/// opens; frames of an earlier series in the folder that it does not name are removed. Beside them stands
/// open_in_paraview.py, which shows the series coloured. Every file is complete or not there. All members
/// throw WriteError.
class SeriesWriter {
 public:
  /// Makes `folder` where there is none.
  explicit SeriesWriter(std::filesystem::path folder, SeriesOptions options = {});

  /// Goes on with the series in `folder` after its frame at `time` [s]; later ones are removed.
  /// Throws ReadError if its .pvd cannot be read or names no such frame.
  static SeriesWriter resume(std::filesystem::path folder, double time, SeriesOptions options = {});

  /// Adds a frame. Throws std::invalid_argument if it is not consistent or earlier than the last.
  void write(const Frame& frame);

  const std::vector<SeriesFrame>& frames() const { return frames_; }  ///< written so far
  std::filesystem::path pvd() const;

 private:
  void write_pvd() const;
  void remove_unnamed_frames() const;
  std::filesystem::path folder_;
  SeriesOptions options_;
  std::vector<SeriesFrame> frames_;
};

}  // namespace porosph
