#include <catch2/catch.hpp>

#include "tests/unit/run_folder/temporary_folder.hpp"
#include "vtk_io/pvd.hpp"
#include "vtk_io/read_series.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

namespace {

std::vector<SeriesFrame> frames_from(const TemporaryFolder& folder, const std::string& text) {
  put(folder / "particles.pvd", text);
  return read_pvd(folder / "particles.pvd");
}

std::string collection(const std::string& data_sets) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\"><Collection>" + data_sets +
         "</Collection></VTKFile>\n";
}

std::string data_set(const std::string& time, const std::string& file) {
  return "<DataSet timestep=\"" + time + "\" file=\"" + file + "\"/>";
}

}  // namespace

TEST_CASE("times and names come back from a .pvd as they were") {
  const TemporaryFolder folder;
  const std::vector<SeriesFrame> frames{
      {0, "frames/a.vtp"}, {5e-324, "with & < > \" ' ü.vtp"}, {0.1, "b"}, {1.0 / 3, "c"}, {1e300, "d"}};
  const auto read = frames_from(folder, pvd_text(frames));
  REQUIRE(read.size() == frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    CHECK(read[i].time == frames[i].time);
    CHECK(read[i].file == frames[i].file);
  }
}

TEST_CASE("the .pvd is what ParaView expects") {
  CHECK(pvd_text({{0.5, "frames/a.vtp"}}) ==
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"Collection\" version=\"0.1\">\n"
        "  <Collection>\n"
        "    <DataSet timestep=\"0.5\" part=\"0\" file=\"frames/a.vtp\"/>\n"
        "  </Collection>\n"
        "</VTKFile>\n");
}

TEST_CASE("a .pvd cannot lead out of its folder") {
  const TemporaryFolder folder;
  for (const std::string name :
       {"/etc/passwd", "../a.vtp", "frames/../../a.vtp", "..", "", "frames/", "a/.."}) {
    CHECK_THROWS_WITH(
        frames_from(folder, collection(data_set("0", name))),
        Contains("particles.pvd") && Contains("'" + name + "' is not a file inside its folder"));
  }
  CHECK(frames_from(folder, collection(data_set("0", "..a/b..vtp"))).size() == 1);
}

TEST_CASE("bad times are refused") {
  const TemporaryFolder folder;
  for (const std::string time : {"", "x", "1s", "nan", "inf", "1e999"}) {
    CHECK_THROWS_WITH(frames_from(folder, collection(data_set(time, "a.vtp"))),
                      Contains("timestep '" + time + "'"));
  }
  CHECK_THROWS_WITH(frames_from(folder, collection(data_set("1", "a.vtp") + data_set("0.5", "b.vtp"))),
                    Contains("time 0.5 stands after 1"));
}

TEST_CASE("a .pvd that is cut short, foreign, empty or hostile is a ReadError") {
  const TemporaryFolder folder;
  const auto text = collection(data_set("0", "a.vtp"));
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    CHECK_THROWS_AS(frames_from(folder, text.substr(0, length)), ReadError);
  }
  CHECK_THROWS_WITH(frames_from(folder, "<html></html>"), Contains("not a ParaView collection"));
  CHECK_THROWS_AS(frames_from(folder, "<VTKFile type=\"PolyData\"></VTKFile>"), ReadError);
  CHECK_THROWS_AS(frames_from(folder, std::string("\0\xff", 2)), ReadError);
  std::string nested;
  for (int i = 0; i < 200000; ++i) nested += "<a>";
  CHECK_THROWS_AS(frames_from(folder, nested), ReadError);
  std::string bomb = "<?xml version=\"1.0\"?><!DOCTYPE x [<!ENTITY a0 \"aaaaaaaaaa\">";
  for (int i = 1; i < 12; ++i) {
    bomb += "<!ENTITY a" + std::to_string(i) + " \"";
    for (int k = 0; k < 10; ++k) bomb += "&a" + std::to_string(i - 1) + ";";
    bomb += "\">";
  }
  CHECK_THROWS_AS(frames_from(folder, bomb + "]><VTKFile type=\"Collection\">&a11;</VTKFile>"), ReadError);
}

TEST_CASE("a series without frames, or without a file, is a ReadError") {
  const TemporaryFolder folder;
  put(folder / "particles.pvd", collection(""));
  CHECK_THROWS_WITH(open_series(folder / "particles.pvd"), Contains("names no frames"));
  CHECK_THROWS_WITH(open_series(folder / "none.pvd"), Contains("No such file or directory"));
}
