// porosph import: drawings of each format become cases that can be computed.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "app/import/ground.hpp"
#include "app/import/meeting_outlines.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/shapes.hpp"
#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

const std::string levee = POROSPH_SOURCE_DIR "/cases/drawings/levee.dxf";
const std::string levee_of_lines = POROSPH_SOURCE_DIR "/cases/drawings/levee_lines.dxf";

/// A drawing of a soil on another one, with a water line over both and a probe, in one format each.
const std::string geojson = R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"layer": "sand"}, "geometry":
 {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 1], [0, 1], [0, 0]]]}},
{"type": "Feature", "properties": {"layer": "stiff clay"}, "geometry":
 {"type": "Polygon", "coordinates": [[[0, 1], [4, 1.0004], [4, 2], [0, 2], [0, 1]]]}},
{"type": "Feature", "properties": {"layer": "water"}, "geometry":
 {"type": "LineString", "coordinates": [[0, 3], [4, 3]]}},
{"type": "Feature", "properties": {"layer": "probes", "name": "A"}, "geometry":
 {"type": "Point", "coordinates": [2, 1.5]}}]})";
const std::string csv =
    "layer,x,y,name\nsand,0,0,\nsand,4,0,\nsand,4,1,\nsand,0,1,\nstiff clay,0,1,\nstiff "
    "clay,4,1.0004,\nstiff "
    "clay,4,2,\nstiff clay,0,2,\nwater,0,3,\nwater,4,3,\nprobes,2,1.5,A\n";
const std::string wkt =
    "# two soils\nsand: POLYGON ((0 0, 4 0, 4 1, 0 1, 0 0))\nstiff clay: POLYGON ((0 1, 4 1.0004, 4 2, 0 2, "
    "0 "
    "1))\nwater: LINESTRING (0 3, 4 3)\nprobe A: POINT (2 1.5)\n";

Case imported(const Workplace& place, const std::string& arguments) {
  const Outcome done = place.porosph("import " + arguments + " --force --out case.toml");
  CAPTURE(done.err);
  REQUIRE(done.status == 0);
  return read_case(place.folder() / "case.toml");
}

}  // namespace

TEST_CASE("GeoJSON, CSV and WKT give the same case", "[import]") {
  const Workplace place;
  for (const auto& [name, text] :
       {std::pair{"ground.geojson", geojson}, {"ground.csv", csv}, {"ground.wkt", wkt}}) {
    place.write(name, text);
    CAPTURE(name);
    const Case scene = imported(place, name);
    REQUIRE(scene.soils.size() == 2);
    CHECK(scene.soils[0].name == "sand");
    CHECK(scene.soils[1].name == "stiff_clay");
    CHECK(scene.soils[0].polygon == Polygon{{0, 0}, {4, 0}, {4, 1}, {0, 1}});
    CHECK(scene.soils[1].polygon == Polygon{{0, 1}, {4, 1}, {4, 2}, {0, 2}});  // meets the sand
    CHECK(scene.soils[1].law == LawKind::mohr_coulomb);
    CHECK(scene.water.mode == WaterMode::still);
    CHECK(scene.water.stretches.at(0).level == 3);
    REQUIRE(scene.probes.size() == 1);
    CHECK(scene.probes[0].position == Point(2, 1.5));
    REQUIRE(scene.boundaries.size() == 3);
    CHECK(std::ranges::count(scene.boundaries, BoundaryKind::fixed, &BoundaryCase::kind) == 1);
  }
}

TEST_CASE("the levee of the tutorial is computed between its two water levels", "[import]") {
  const Workplace place;
  const Outcome frame = place.porosph("import " + levee);
  CHECK(frame.status == 2);
  CHECK_THAT(frame.err, Contains("'frame' surrounds 'clay' and another soil"));
  const Case scene = imported(place, levee + " --skip frame --spacing \"100 cm\"");
  CHECK(scene.particles.spacing == 1);
  CHECK(scene.soils.size() == 3);
  CHECK(scene.probes.at(1).name == "toe");  // by the text beside it
  CHECK(scene.probes.at(1).position == Point(34, 0.3));
  CHECK(scene.water.mode == WaterMode::steady);
  CHECK(std::ranges::count(scene.water.faces, FaceKind::head, &HydraulicFaceCase::kind) == 2);
  CHECK_THAT(text_of(place.folder() / "case.toml"), Contains("FILL IN"));
  CHECK(place.porosph("check case.toml").status == 0);
  const Outcome run = place.porosph("run case.toml --set time.end=0.05");
  CAPTURE(run.err);
  CHECK(run.status == 0);
  REQUIRE(place.porosph("report results/case --out report").status == 0);
  const std::string page = text_of(place.folder() / "report/index.html");
  const auto summary = nlohmann::json::parse(text_of(place.folder() / "results/case/summary.json"));
  double enters = 0;
  for (const double flow : summary["seepage"]["through_faces"]) enters += std::max(flow, 0.);
  CHECK_THAT(page, Contains("Water balance") && Contains("head 4.5 m, (") &&
                       Contains(fmt::format("{:.3g}", enters)));
}

TEST_CASE("a drawing in millimetres says so, or the user does", "[import]") {
  const Workplace place;
  place.write("small.wkt", "sand: POLYGON ((0 0, 4000 0, 4000 2000, 0 2000, 0 0))\n");
  CHECK(imported(place, "small.wkt --unit mm").soils[0].polygon[2] == Point(4, 2));
  std::string dxf = text_of(levee);
  const auto at = dxf.find("$INSUNITS\n70\n6");
  REQUIRE(at != std::string::npos);
  place.write("levee_mm.dxf", dxf.replace(at, 14, "$INSUNITS\n70\n4"));
  CHECK(imported(place, "levee_mm.dxf --skip frame --snap 1e-6").soils[0].polygon[1].x() == Approx(0.036));
}

TEST_CASE("supports as drawn replace those at base and ends, and layers may be called anything", "[import]") {
  const Workplace place;
  place.write(
      "a.wkt",
      "sand: POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))\nfixed: LINESTRING (0 0, 4 0)\nGWL: LINESTRING (-1 1, 5 "
      "1)\nwatery clay: POLYGON ((4 0, 8 0, 8 2, 4 2, 4 0))\n");
  const Case scene = imported(place, "a.wkt --water GWL --soil 'watery clay'");
  CHECK(scene.boundaries.size() == 1);
  CHECK(scene.soils.at(1).name == "watery_clay");
  CHECK(scene.water.mode == WaterMode::steady);  // the line ends over the soil
  REQUIRE(std::ranges::count(scene.water.faces, FaceKind::head, &HydraulicFaceCase::kind) == 1);
  const auto head = std::ranges::find(scene.water.faces, FaceKind::head, &HydraulicFaceCase::kind);
  CHECK(head->level == 1);  // at the left end, within the soil
  CHECK_THAT(place.porosph("import a.wkt --water GWL --soil 'watery clay' --force").out,
             Contains("ends in the soil at (5, 1) m"));
}

TEST_CASE("a levee of open lines is the same as one of closed outlines", "[import]") {
  const Workplace place;
  const Case closed = imported(place, levee + " --skip frame --spacing 1");
  const Outcome told = place.porosph("import " + levee_of_lines + " --spacing 1 --force --out case.toml");
  REQUIRE(told.status == 0);
  CHECK_THAT(told.out, Contains("water falls from (-20, 4.5) to (60, 0) m: taken as steady flow"));
  CHECK_THAT(told.out, Contains("ends up to 0.0005 m apart were made one") && !Contains("next one"));
  const Case lines = read_case(place.folder() / "case.toml");
  REQUIRE(lines.soils.size() == 3);
  for (const SoilCase& soil : closed.soils) {
    const auto same = std::ranges::find(lines.soils, soil.name, &SoilCase::name);
    CAPTURE(soil.name);
    REQUIRE(same != lines.soils.end());
    CHECK(area(*same) == Approx(area(soil)).epsilon(1e-5));  // half a millimetre of the drawing's gap
    CHECK(overlap(soil, *same).area == Approx(area(soil)).epsilon(1e-5));
  }
  REQUIRE(lines.water.faces.size() == closed.water.faces.size());
  for (const FaceKind kind : {FaceKind::head, FaceKind::seepage, FaceKind::closed})
    CHECK(std::ranges::count(lines.water.faces, kind, &HydraulicFaceCase::kind) ==
          std::ranges::count(closed.water.faces, kind, &HydraulicFaceCase::kind));
  CHECK(lines.boundaries.size() == closed.boundaries.size());
  CHECK(lines.probes.at(1).position == closed.probes.at(1).position);
  CHECK(place.porosph("check case.toml").status == 0);
}

TEST_CASE("lines become soils by the texts between them", "[import]") {
  const Workplace place;
  place.write("t.csv",
              "layer,wkt,text\nlines,\"LINESTRING (-1 0, 9 0)\",\nlines,\"LINESTRING (0 -1, 0 5)\",\n"
              "lines,\"LINESTRING (8 -1, 8 5)\",\nlines,\"LINESTRING (0 2, 8 2)\",\n"
              "lines,\"LINESTRING (0 4, 8 4.0)\",\nlens,\"LINESTRING (3 0.5, 5 0.5, 5 1.5, 3 1.5, 3 0.5)\",\n"
              "lines,\"LINESTRING (4 0.5, 4 1.5)\",\nnames,POINT (1 1),clay\nnames,POINT (1 3),sand\n"
              "names,POINT (3.5 1),peat\nnames,POINT (4 6),Section A\n");
  SECTION("as they are") {
    const Outcome told = place.porosph("import t.csv --spacing 0.25 --out case.toml");
    CAPTURE(told.err);
    REQUIRE(told.status == 0);
    CHECK_THAT(told.out, Contains("text 'Section A' at (4, 6) m: left out"));
    const Case scene = read_case(place.folder() / "case.toml");
    REQUIRE(scene.soils.size() == 4);
    const auto of = [&](const std::string& name) {
      return *std::ranges::find(scene.soils, name, &SoilCase::name);
    };
    CHECK(area(of("clay")) == Approx(14));  // around the lens, which is two soils
    CHECK(of("clay").holes.size() == 1);
    CHECK(area(of("sand")) == Approx(16));
    CHECK(area(of("peat")) == Approx(1));
    CHECK(area(of("lens")) == Approx(1));  // by the layer of the closed line around it
    CHECK(place.porosph("check case.toml").status == 0);
  }
  SECTION("named and emptied on the command line") {
    const Case scene = imported(place, "t.csv --name 4.5,1=gravel --empty 1,3 --spacing 0.25");
    CHECK(scene.soils.size() == 3);
    CHECK(std::ranges::count(scene.soils, "gravel", &SoilCase::name) == 1);
    CHECK(std::ranges::count(scene.soils, "sand", &SoilCase::name) == 0);
    CHECK_THAT(place.porosph("import t.csv --name 20,1=gravel").err, Contains("(20, 1) m is in no region"));
    CHECK_THAT(place.porosph("import t.csv --name gravel").err, Contains("must be X,Y=SOIL"));
    CHECK_THAT(place.porosph("import t.csv --empty 3").err, Contains("must begin with X,Y"));
  }
}

TEST_CASE("lines that leave gaps or doubt are refused by place", "[import]") {
  const Workplace place;
  const std::string box =
      "base: LINESTRING (0 0, 8 0)\nends: LINESTRING (0 0, 0 4)\nends: LINESTRING (8 0, 8 4)\n"
      "ground: LINESTRING (0 4, 7.8 4)\n";
  const auto import_of = [&](const std::string& more, const std::string& options) {
    place.write("a.wkt", box + more);
    return place.porosph("import a.wkt --force --spacing 0.5 " + options);
  };
  const Outcome open = import_of("", "");
  CHECK(open.status == 2);
  CHECK_THAT(open.err, Contains("the lines enclose nothing") &&
                           Contains("on layer 'ground' ends at (7.8, 4) m, 0.2 m from the next one") &&
                           Contains("--snap 0.2"));
  CHECK_THAT(import_of("", "--snap 0.21").err, Contains("no text names the region around (") &&
                                                   Contains(" m2 and about ") && Contains("--empty"));
  const Outcome bridged = import_of("", "--snap 0.21 --name 4,2=sand");
  CHECK(bridged.status == 0);
  const Outcome divided =
      import_of("layers: LINESTRING (0 2, 7.5 2)\n", "--snap 0.21 --name 4,1=clay --name 4,3=sand");
  CHECK(divided.status == 0);  // the layer's line ends free: one region, named by the first
  CHECK_THAT(divided.out, Contains("layer 'layers' ends at (7.5, 2) m, 0.5 m from the next one"));

  place.write("b.csv",
              "layer,wkt,text\nl,\"LINESTRING (0 0, 8 0, 8 4, 0 4, 0 0)\",\nl,\"LINESTRING (0 2, 7.5 2)\",\n"
              "l,\"LINESTRING (4 0, 4 2)\",\nn,POINT (2 1),peat\nn,POINT (6 1),clay\nn,POINT (1 3),sand\n");
  const Outcome two = place.porosph("import b.csv");
  CHECK(two.status == 2);
  CHECK_THAT(two.err, Contains("texts 'clay' at (6, 1) and 'sand' at (1, 3) m are in one region") &&
                          Contains("0.5 m from the next one") && Contains("--snap 0.51"));
  CHECK(place.porosph("import b.csv --snap 0.51").status == 0);
}

TEST_CASE("water that falls flows between the levels at its ends", "[import]") {
  const Workplace place;
  const std::string box = "sand: POLYGON ((0 0, 8 0, 8 4, 0 4, 0 0))\n";
  place.write("a.wkt", box + "water: LINESTRING (-1 3.25, 9 0.75)\n");
  const Case scene = imported(place, "a.wkt --spacing 0.25");
  std::vector<double> levels;
  for (const HydraulicFaceCase& face : scene.water.faces)
    if (face.kind == FaceKind::head) levels.push_back(face.level);
  std::ranges::sort(levels);
  CHECK(levels == std::vector<double>{1, 3});
  CHECK(place.porosph("check case.toml").status == 0);
  place.write("a.wkt", box + "water: LINESTRING (0 3, 3 3, 8 3)\n");
  CHECK(imported(place, "a.wkt").water.mode == WaterMode::still);  // one level in two pieces
  place.write("a.wkt", box + "water: LINESTRING (3 3, 5 3)\n");
  CHECK_THAT(place.porosph("import a.wkt --force").err, Contains("no level drives its flow"));
}

TEST_CASE("drawings that cannot be taken are refused by name", "[import]") {
  const Workplace place;
  const auto refused = [&](const std::string& file, const std::string& text,
                           const std::string& options = "") {
    place.write(file, text);
    const Outcome done = place.porosph("import " + file + " " + options);
    CHECK(done.status == 2);
    CHECK_THAT(done.err, Contains(file));
    CHECK_FALSE(std::filesystem::exists(place.folder() / "a.toml"));
    return done.err;
  };
  const std::string box = "sand: POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))\n";
  CHECK_THAT(refused("a.wkt", box + "water: LINESTRING (0 5, 4 3)\n"),
             Contains("water falls from (0, 5) to (4, 3) m above the ground"));
  CHECK_THAT(refused("a.wkt", "sand: LINESTRING (0 0, 4 0)\n"),
             Contains("the lines enclose nothing: a line on layer 'sand' ends at (0, 0) m"));
  CHECK_THAT(refused("a.wkt", "sand: POLYGON 0 0\n"), Contains("line 1: is not 'layer: WKT'"));
  CHECK_THAT(refused("a.wkt", box, "--water lake"), Contains("has no layer 'lake'; it has 'sand'"));
  CHECK_THAT(refused("a.wkt", "sand: POLYGON ((0 0, 4 0, nan 2, 0 2, 0 0))\n"), Contains("a.wkt"));
  CHECK_THAT(refused("a.geojson", "{"), Contains("cannot be read"));
  CHECK_THAT(refused("a.dxf", "nothing\n"), Contains("a.dxf"));
  CHECK_THAT(refused("a.svg", box), Contains("must end in .dxf"));
  CHECK_THAT(place.porosph("import none.dxf").err, Contains("none.dxf: is not a readable file"));
  place.write("a.wkt", box);
  CHECK_THAT(place.porosph("import a.wkt --snap '1 kPa'").err,
             Contains("'kPa', which does not convert to m"));
  CHECK_THAT(place.porosph("import a.wkt --unit stone").err, Contains("must be one of m, km"));
}

TEST_CASE("a program without the reader of drawings says what to install", "[import]") {
  const Workplace place;
  std::filesystem::create_directories(place.folder() / "bin");
  std::filesystem::copy_file(POROSPH_PROGRAM, place.folder() / "bin/porosph");
  CHECK(place.shell("bin/porosph import " + levee) == 2);
  CHECK_THAT(text_of(place.folder() / "err"), Contains("built without GDAL (Debian: install libgdal-dev"));
}

TEST_CASE("outlines drawn by hand are made to meet", "[import]") {
  std::vector<drawn::Region> regions = {
      {"ground", {{{0, 0}, {10, 0}, {10, 4}, {6, 4}, {0, 4.0002}}}},
      {"fill", {{{2, 4}, {6, 4.0003}, {4, 6}, {4, 6}}}},  // its foot lies on the ground's edge
      {"lens", {{{4, 1}, {4, 2}, {6, 2}, {6, 1}}}},       // inside, clockwise
      {"again", {{{6, 1}, {6, 2}, {4, 2}, {4, 1}}}},      // the same
      {"line", {{{0, 8}, {4, 8}, {8, 8}}}},               // without area
  };
  const auto notes = drawn::make_outlines_meet(regions, 1e-3);
  REQUIRE(regions.size() == 3);
  CHECK(notes.size() == 4);
  const Polygon& ground = regions[0].rings[0];
  CHECK(std::ranges::find(ground, Point(2, 4)) != ground.end());
  CHECK(regions[1].rings[0][1] == Point(6, 4));
  REQUIRE(regions[0].rings.size() == 2);  // the lens is a hole
  CHECK(regions[0].rings[1].size() == 4);
}
