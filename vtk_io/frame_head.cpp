#include "vtk_io/frame_head.hpp"

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLParser.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "solver/printable.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/vtk_errors.hpp"

namespace porosph {
namespace {

using Attributes = std::map<std::string, std::string>;

std::string text_of(const Attributes& attributes, const std::string& key, const std::string& otherwise = {}) {
  const auto found = attributes.find(key);
  return found == attributes.end() ? otherwise : found->second;
}

/// Follows the elements down to AppendedData, behind which there is no XML.
class HeadParser : public vtkXMLParser {
 public:
  static HeadParser* New() { VTK_STANDARD_NEW_BODY(HeadParser); }

  FrameHead head;
  std::string fault;             ///< the first thing that does not fit
  long long appended_data = -1;  ///< place of the element in the text, once it was met

 protected:
  void StartElement(const char* name, const char** list) override {
    Attributes attributes;
    for (; list[0] != nullptr; list += 2) attributes[list[0]] = list[1];
    const std::string_view element = name;
    if (path_.empty()) {
      begin_file(element, attributes);
    } else if (element == "Piece") {
      begin_piece(attributes);
    } else if (element == "DataArray" && is_wanted(path_.back())) {
      add_array(attributes);
    } else if (element == "AppendedData" && path_.size() == 1) {
      if (text_of(attributes, "encoding") != "raw") blame("its data are not raw");
      appended_data = GetXMLByteIndex();
    }
    path_.emplace_back(element);
  }
  void EndElement(const char*) override { path_.pop_back(); }

 private:
  static bool is_wanted(const std::string& section) {
    return section == "Points" || section == "PointData" || section == "FieldData";
  }

  void begin_file(std::string_view element, const Attributes& attributes) {
    const auto type = text_of(attributes, "type");
    if (element != "VTKFile" || (type != "PolyData" && type != "UnstructuredGrid")) {
      blame("not a VTKFile of type PolyData or UnstructuredGrid");
    }
    if (text_of(attributes, "byte_order") != "LittleEndian") blame("its byte order is not LittleEndian");
    const auto header = text_of(attributes, "header_type", "UInt32");
    if (header != "UInt32" && header != "UInt64") blame(fmt::format("unknown header_type '{}'", header));
    head.header_bytes = header == "UInt64" ? 8 : 4;
    head.compressor = text_of(attributes, "compressor");
  }

  void begin_piece(const Attributes& attributes) {
    if (++pieces_ > 1) blame("it has more than one piece");
    head.points = number(attributes, "NumberOfPoints", 0);
  }

  void add_array(const Attributes& attributes) {
    ArrayHead array;
    array.section = path_.back();
    array.name = text_of(attributes, "Name");
    array.type = text_of(attributes, "type");
    array.components = number(attributes, "NumberOfComponents", 1);
    array.tuples = array.section == "FieldData" ? number(attributes, "NumberOfTuples", 0) : head.points;
    array.offset = number(attributes, "offset", 0);
    for (std::uint64_t c = 0; attributes.contains(component_key(c)); ++c) {
      array.component_names.push_back(attributes.at(component_key(c)));
    }
    if (array.component_names.size() != array.components) array.component_names.clear();
    require_plain(array.name);
    for (const std::string& component : array.component_names) require_plain(component);
    if (text_of(attributes, "format") != "appended")
      blame(fmt::format("the data of {} are not appended", array.name));
    head.arrays.push_back(std::move(array));
  }

  /// Names are shown on terminals and pages.
  void require_plain(const std::string& name) {
    if (!control_character(name).empty())
      blame(fmt::format("the name of an array or component has control characters: '{}'", printable(name)));
  }

  static std::string component_key(std::uint64_t component) {
    return fmt::format("ComponentName{}", component);
  }

  std::uint64_t number(const Attributes& attributes, const std::string& key, std::uint64_t otherwise) {
    const auto found = attributes.find(key);
    if (found == attributes.end()) return otherwise;
    auto text = std::string_view(found->second);
    text = text.substr(0, text.find_last_not_of(' ') + 1);  // VTK pads what it fills in later
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
      blame(fmt::format("{} is '{}', not a whole number", key, text));
    }
    return value;
  }

  void blame(const std::string& what) {
    if (fault.empty()) fault = what;
  }

  std::vector<std::string> path_;
  int pieces_ = 0;
};

}  // namespace

FrameHead read_head(const std::filesystem::path& file, std::string_view text) {
  if (!text.substr(0, text.find_last_not_of(" \r\n") + 1).ends_with("</VTKFile>")) {
    throw ReadError(file, "it is cut short, or not a VTK XML file: it does not end with </VTKFile>");
  }
  constexpr std::size_t chunk = 4096;
  vtkNew<VtkErrors> errors;
  vtkNew<HeadParser> parser;
  errors->watch(*parser);
  parser->InitializeParser();
  for (auto rest = text;
       !rest.empty() && parser->appended_data < 0 && parser->fault.empty() && !errors->any();
       rest.remove_prefix(std::min(chunk, rest.size()))) {
    parser->ParseChunk(rest.data(), static_cast<unsigned>(std::min(chunk, rest.size())));
  }
  const auto appended_data = parser->appended_data;
  const auto fault = parser->fault;
  const auto syntax = errors->first();
  parser->CleanupParser();
  if (!fault.empty()) throw ReadError(file, fault);
  if (appended_data < 0) {
    throw ReadError(file, syntax.empty() ? "it ends before its data" : "not XML: " + syntax);
  }
  const auto mark = text.find('_', text.find('>', static_cast<std::size_t>(appended_data)));
  if (mark == text.npos) throw ReadError(file, "it ends before its data");
  parser->head.data_begin = mark + 1;
  return parser->head;
}

}  // namespace porosph
