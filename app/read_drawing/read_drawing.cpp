// read_drawing FILE: writes the shapes of a drawing as JSON, for porosph import.
//
// {"unit": "mm", "shapes": [{"layer": "clay", "text": "", "kind": "area", "rings": [[[x, y], ...], ...]},
// ...],
//  "left_out": ["3 hatches on layer 'clay'", ...]}   or   {"error": "..."}
//
// Kinds are area (outline, then holes), line and point (one ring each). DXF, GeoJSON and CSV are GDAL's; a
// .wkt file has one shape a line, "layer: POLYGON ((...))".
//
// read_drawing --regions: reads lines from the standard input and writes what they enclose (regions.hpp).
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/read_drawing/regions.hpp"

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// The shapes and what could not be taken, as they are found.
struct Found {
  Json shapes = Json::array();
  std::map<std::string, int> left_out;

  void add(const std::string& layer, const std::string& text, std::string_view kind, Json rings) {
    shapes.push_back({{"layer", layer}, {"text", text}, {"kind", kind}, {"rings", std::move(rings)}});
  }
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

Json points_of(const OGRSimpleCurve& curve) {
  Json points = Json::array();
  for (int i = 0; i < curve.getNumPoints(); ++i) points.push_back({curve.getX(i), curve.getY(i)});
  return points;
}

void add_geometry(const OGRGeometry& any, const std::string& layer, const std::string& text, Found& found) {
  const std::unique_ptr<OGRGeometry> straight(any.getLinearGeometry());
  if (!straight || straight->IsEmpty()) return;
  const auto kind = wkbFlatten(straight->getGeometryType());
  if (kind == wkbPoint) {
    const OGRPoint& p = *straight->toPoint();
    found.add(layer, text, "point", Json::array({Json::array({Json::array({p.getX(), p.getY()})})}));
  } else if (kind == wkbLineString) {
    found.add(layer, text, "line", Json::array({points_of(*straight->toLineString())}));
  } else if (kind == wkbPolygon) {
    Json rings = Json::array();
    for (const OGRLinearRing* ring : *straight->toPolygon()) rings.push_back(points_of(*ring));
    found.add(layer, text, "area", std::move(rings));
  } else if (OGR_GT_IsSubClassOf(kind, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *straight->toGeometryCollection()) add_geometry(*part, layer, text, found);
  } else {
    ++found.left_out[std::string(straight->getGeometryName()) + " on layer '" + layer + "'"];
  }
}

/// The first of these attributes that a feature has and that is not empty; their names in any case.
std::string attribute(const OGRFeature& feature, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    const int index = feature.GetDefnRef()->GetFieldIndex(name);  // in any case
    if (index < 0 || !feature.IsFieldSetAndNotNull(index)) continue;
    if (const std::string value = feature.GetFieldAsString(index); !value.empty()) return value;
  }
  return "";
}

void add_feature(const OGRFeature& feature, const std::string& name_of_all, bool is_dxf, Found& found) {
  std::string layer = attribute(feature, {"layer", "soil", "name"});
  if (layer.empty()) layer = name_of_all;
  std::string text = attribute(feature, {"text"});
  if (text.empty() && !is_dxf && attribute(feature, {"name"}) != layer) text = attribute(feature, {"name"});
  if (is_dxf && attribute(feature, {"subclasses"}).find("AcDbHatch") != std::string::npos) {
    ++found.left_out["hatch on layer '" + layer + "'"];
    return;
  }
  if (const OGRGeometry* geometry = feature.GetGeometryRef())
    add_geometry(*geometry, layer, text, found);
  else
    ++found.left_out["entry without a shape on layer '" + layer + "'"];
}

/// Rows of x and y that follow each other with one layer are a line, unless they have a text each: then they
/// are points.
void join_rows(Found& found) {
  Json joined = Json::array();
  for (Json& shape : found.shapes) {
    const bool bare = shape["kind"] == "point" && shape["text"] == "";
    const bool follows = bare && !joined.empty() && joined.back()["kind"] == "line" &&
                         joined.back().contains("of_rows") && joined.back()["layer"] == shape["layer"];
    if (follows) {
      joined.back()["rings"][0].push_back(shape["rings"][0][0]);
      continue;
    }
    joined.push_back(std::move(shape));
    if (bare) joined.back()["kind"] = "line", joined.back()["of_rows"] = true;
  }
  for (Json& shape : joined) {
    if (shape.erase("of_rows") == 0) continue;
    // A line, or an outline where a soil is meant.
    shape["kind"] = shape["rings"][0].size() == 1 ? "point" : "rows";
  }
  found.shapes = std::move(joined);
}

/// What the coordinates of a DXF file are in, by its header: "" where it does not say.
std::string unit_of_dxf(const fs::path& file) {
  static const std::map<int, std::string> units = {{1, "in"}, {2, "ft"}, {4, "mm"},
                                                   {5, "cm"}, {6, "m"},  {7, "km"}};
  std::ifstream stream(file);
  std::string line;
  for (int i = 0; i < 20000 && std::getline(stream, line); ++i) {
    if (line.find("$INSUNITS") == std::string::npos) continue;
    std::getline(stream, line);
    std::getline(stream, line);
    const auto found = units.find(std::atoi(line.c_str()));
    return found == units.end() ? "" : found->second;
  }
  return "";
}

void read_by_gdal(const fs::path& file, const char* driver, Found& found) {
  GDALAllRegister();
  const char* const drivers[] = {driver, nullptr};
  const char* const options[] = {"X_POSSIBLE_NAMES=x,X", "Y_POSSIBLE_NAMES=y,Y",
                                 "GEOM_POSSIBLE_NAMES=wkt,WKT,geometry,geom", "KEEP_GEOM_COLUMNS=NO",
                                 nullptr};
  const bool is_csv = std::string(driver) == "CSV";
  const std::unique_ptr<GDALDataset> data(
      GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR, drivers, is_csv ? options : nullptr, nullptr));
  if (!data) throw std::runtime_error(CPLGetLastErrorMsg());
  for (OGRLayer* layer : data->GetLayers())
    for (const auto& feature : *layer)
      add_feature(*feature, file.stem().string(), std::string(driver) == "DXF", found);
  if (is_csv) join_rows(found);
}

void read_wkt(const fs::path& file, Found& found) {
  std::ifstream stream(file);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    const std::size_t bracket = line.find('('), colon = line.rfind(':', bracket);
    std::string layer = file.stem().string(), shape = line.substr(begin);
    if (colon != std::string::npos) layer = line.substr(begin, colon - begin), shape = line.substr(colon + 1);
    OGRGeometry* geometry = nullptr;
    const char* text = shape.c_str();
    const bool read = OGRGeometryFactory::createFromWkt(&text, nullptr, &geometry) == OGRERR_NONE;
    const std::unique_ptr<OGRGeometry> owner(geometry);
    if (!read || !geometry)
      throw std::runtime_error("line " + std::to_string(number) +
                               ": is not 'layer: WKT', as clay: POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))");
    add_geometry(*geometry, layer, "", found);
  }
}

Json read(const fs::path& file) {
  Found found;
  std::string unit;
  const std::string kind = lower(file.extension().string());
  if (kind == ".dxf") {
    read_by_gdal(file, "DXF", found);
    unit = unit_of_dxf(file);
  } else if (kind == ".geojson" || kind == ".json") {
    read_by_gdal(file, "GeoJSON", found);
  } else if (kind == ".csv") {
    read_by_gdal(file, "CSV", found);
  } else if (kind == ".wkt") {
    read_wkt(file, found);
  } else {
    throw std::runtime_error("its name must end in .dxf, .geojson, .json, .csv or .wkt");
  }
  Json left_out = Json::array();
  for (const auto& [what, count] : found.left_out) left_out.push_back(std::to_string(count) + " x " + what);
  return {{"unit", unit}, {"shapes", std::move(found.shapes)}, {"left_out", std::move(left_out)}};
}

}  // namespace

int main(int count, char** arguments) {
  CPLSetErrorHandler(CPLQuietErrorHandler);
  Json answer;
  try {
    if (count != 2) throw std::runtime_error("usage: read_drawing FILE|--regions");
    const std::string asked = arguments[1];
    answer = asked == "--regions" ? porosph::drawn::regions_between(Json::parse(std::cin)) : read(asked);
  } catch (const std::exception& error) {
    answer = {{"error", error.what()}};
  }
  std::cout << answer.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
  return answer.contains("error") ? 2 : 0;
}
