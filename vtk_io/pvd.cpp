#include "vtk_io/pvd.hpp"

#include <fmt/format.h>
#include <vtkIndent.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLParser.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/vtk_errors.hpp"

namespace porosph {
namespace fs = std::filesystem;

namespace {

using Attributes = std::map<std::string, std::string>;

/// Collects the DataSet elements of VTKFile/Collection.
class PvdParser : public vtkXMLParser {
 public:
  static PvdParser* New() { VTK_STANDARD_NEW_BODY(PvdParser); }

  bool is_collection = false;
  std::vector<Attributes> data_sets;

 protected:
  void StartElement(const char* name, const char** list) override {
    Attributes attributes;
    for (; list[0] != nullptr; list += 2) attributes[list[0]] = list[1];
    const std::string_view element = name;
    if (depth_ == 0) is_collection = element == "VTKFile" && attributes["type"] == "Collection";
    if (depth_ == 2 && element == "DataSet") data_sets.push_back(std::move(attributes));
    ++depth_;
  }
  void EndElement(const char*) override { --depth_; }

 private:
  int depth_ = 0;
};

/// Inside the folder of the .pvd: relative, and never upwards.
bool stays_inside(const fs::path& file) {
  return !file.empty() && file.is_relative() && file.has_filename() &&
         std::none_of(file.begin(), file.end(), [](const fs::path& part) { return part == ".."; });
}

double time_from(const fs::path& file, const std::string& text) {
  double time = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(time)) {
    throw ReadError(file, fmt::format("timestep '{}' is not a number", text));
  }
  return time;
}

SeriesFrame frame_from(const fs::path& file, Attributes attributes) {
  SeriesFrame frame{time_from(file, attributes["timestep"]), attributes["file"]};
  if (!stays_inside(frame.file)) {
    throw ReadError(file, fmt::format("'{}' is not a file inside its folder", frame.file));
  }
  return frame;
}

}  // namespace

std::string pvd_text(const std::vector<SeriesFrame>& frames) {
  vtkNew<vtkXMLDataElement> root, collection;
  root->SetName("VTKFile");
  root->SetAttribute("type", "Collection");
  root->SetAttribute("version", "0.1");
  collection->SetName("Collection");
  root->AddNestedElement(collection);
  const auto add = [&](double time, const char* part, const char* name, const std::string& file) {
    vtkNew<vtkXMLDataElement> data_set;
    data_set->SetName("DataSet");
    data_set->SetAttribute("timestep", fmt::format("{}", time).c_str());
    data_set->SetAttribute("group", "");
    data_set->SetAttribute("part", part);
    if (*name != '\0') data_set->SetAttribute("name", name);
    data_set->SetAttribute("file", file.c_str());
    collection->AddNestedElement(data_set);
  };
  for (const auto& frame : frames) {
    const bool alone = frame.boundary_file.empty();
    add(frame.time, "0", alone ? "" : "particles", frame.file);
    if (!alone) add(frame.time, "1", "boundary", frame.boundary_file);
  }
  std::ostringstream text;
  text << "<?xml version=\"1.0\"?>\n";
  root->PrintXML(text, vtkIndent());
  return text.str();
}

std::vector<SeriesFrame> read_pvd(const fs::path& file) {
  const auto text = read_file(file);
  vtkNew<VtkErrors> errors;
  vtkNew<PvdParser> parser;
  errors->watch(*parser);
  const bool parsed = parser->Parse(text.data(), static_cast<unsigned>(text.size())) != 0;
  if (!parsed || errors->any()) {
    throw ReadError(file, "not well-formed XML" + (errors->any() ? ": " + errors->first() : ""));
  }
  if (!parser->is_collection) throw ReadError(file, "not a ParaView collection (VTKFile of type Collection)");
  std::vector<SeriesFrame> frames;
  for (auto& attributes : parser->data_sets) {
    const bool second_block = attributes["part"] == "1";
    auto frame = frame_from(file, std::move(attributes));
    if (second_block && !frames.empty() && frames.back().time == frame.time) {
      frames.back().boundary_file = frame.file;
      continue;
    }
    if (!frames.empty() && frame.time < frames.back().time) {
      throw ReadError(file, fmt::format("time {} stands after {}", frame.time, frames.back().time));
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace porosph
