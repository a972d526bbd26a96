#include "vtk_io/particle_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "vtk_io/frame_file.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/checksum.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/sheets_vtp.hpp"

namespace porosph {
namespace fs = std::filesystem;

namespace {

constexpr const char* frames_folder = "frames";
constexpr const char *pvd_name = "particles.pvd", *sheets_pvd_name = "sheets.pvd";

std::string frame_name(const char* block, std::size_t number, FrameFormat format) {
  return fmt::format("{}/{}_{:06}.{}", frames_folder, block, number,
                     format == FrameFormat::poly_data ? "vtp" : "vtu");
}

bool is_frame(const fs::path& file) {
  const auto name = file.filename().string();
  return (name.starts_with("particles_") || name.starts_with("boundary_") || name.starts_with("sheets_")) &&
         (file.extension() == ".vtp" || file.extension() == ".vtu");
}

}  // namespace

std::string sheets_file(const SeriesFrame& frame) {
  const std::string number = fs::path(frame.file).stem().string().substr(std::string("particles_").size());
  return fmt::format("{}/sheets_{}.vtp", frames_folder, number);
}

SeriesWriter::SeriesWriter(fs::path folder, SeriesOptions options)
    : folder_(std::move(folder)), options_(std::move(options)) {
  make_folder(folder_ / frames_folder);
}

SeriesWriter SeriesWriter::resume(fs::path folder, double time, std::vector<std::uint32_t> checksums,
                                  SeriesOptions options) {
  SeriesWriter series(std::move(folder), std::move(options));
  series.frames_ = read_pvd(series.pvd());
  std::erase_if(series.frames_, [&](const SeriesFrame& frame) { return frame.time > time; });
  if (series.frames_.empty() || series.frames_.back().time != time) {
    throw ReadError(series.pvd(), fmt::format("it has no frame at {} s", time));
  }
  series.check_files(checksums);
  series.checksums_ = std::move(checksums);
  series.write_pvd();
  series.remove_unnamed_frames();
  return series;
}

void SeriesWriter::check_files(const std::vector<std::uint32_t>& checksums) const {
  std::vector<std::string> files;
  for (const SeriesFrame& frame : frames_) {
    files.push_back(frame.file);
    if (!frame.boundary_file.empty()) files.push_back(frame.boundary_file);
  }
  if (files.size() != checksums.size()) {
    throw ReadError(pvd(), fmt::format("it names {} files up to {} s, and the run wrote {}", files.size(),
                                       frames_.back().time, checksums.size()));
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (checksum_of(folder_ / files[i]) != checksums[i])
      throw ReadError(folder_ / files[i], "it is not the file that the run wrote");
  }
}

fs::path SeriesWriter::pvd() const { return folder_ / pvd_name; }

void SeriesWriter::write(const Frame& frame, const std::optional<Frame>& boundary) {
  if (!frames_.empty() && !(frame.time >= frames_.back().time)) {
    throw std::invalid_argument(
        fmt::format("frame: time {} after {} in the series", frame.time, frames_.back().time));
  }
  SeriesFrame entry{frame.time, frame_name("particles", frames_.size(), options_.format)};
  write_frame(folder_ / entry.file, frame, options_);
  checksums_.push_back(checksum_of(folder_ / entry.file));
  if (boundary) {
    entry.boundary_file = frame_name("boundary", frames_.size(), options_.format);
    write_frame(folder_ / entry.boundary_file, *boundary, options_);
    checksums_.push_back(checksum_of(folder_ / entry.boundary_file));
  }
  frames_.push_back(std::move(entry));
  write_pvd();
  if (frames_.size() == 1) {
    remove_unnamed_frames();
    write_file(folder_ / open_script,
               paraview_script(fs::absolute(folder_), pvd_name, frame, options_.scene));
    write_file(folder_ / compare_script, paraview_comparison_script(fs::absolute(folder_), ".", ""));
  }
}

void SeriesWriter::write_sheets(const std::vector<SheetFrame>& sheets) {
  write_sheets_vtp(folder_ / sheets_file(frames_.back()), sheets);
  write_sheets_pvd();
}

void SeriesWriter::write_sheets_pvd() const {
  std::vector<SeriesFrame> frames;
  for (const SeriesFrame& frame : frames_) frames.push_back({frame.time, sheets_file(frame)});
  write_file(folder_ / sheets_pvd_name, pvd_text(frames));
}

void SeriesWriter::write_pvd() const { write_file(pvd(), pvd_text(frames_)); }

void SeriesWriter::remove_unnamed_frames() const {
  std::error_code ignored;  // a file left over does no harm
  for (const auto& entry : fs::directory_iterator(folder_ / frames_folder, ignored)) {
    const auto name = std::string(frames_folder) + "/" + entry.path().filename().string();
    const bool named = std::ranges::any_of(frames_, [&](const SeriesFrame& f) {
      return f.file == name || f.boundary_file == name || sheets_file(f) == name;
    });
    if (!named && is_frame(entry.path())) fs::remove(entry.path(), ignored);
  }
}

}  // namespace porosph
