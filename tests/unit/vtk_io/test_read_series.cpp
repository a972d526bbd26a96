#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLPolyDataWriter.h>

#include <catch2/catch.hpp>
#include <random>

#include "tests/unit/run_folder/temporary_folder.hpp"
#include "tests/unit/vtk_io/example_frame.hpp"
#include "vtk_io/particle_data.hpp"
#include "vtk_io/particle_series.hpp"
#include "vtk_io/read_series.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

namespace {

Frame frame_in(const std::filesystem::path& file) { return frame_of(*read_frame(file)); }

/// The bytes of a frame file.
std::string written(const TemporaryFolder& folder, const Frame& frame, Compression compression) {
  SeriesWriter series(folder.path(), {FrameFormat::poly_data, compression});
  series.write(frame);
  return content(folder / series.frames()[0].file);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  REQUIRE(at != text.npos);
  return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("a series comes back as it was written") {
  const TemporaryFolder folder;
  const auto format = GENERATE(FrameFormat::poly_data, FrameFormat::unstructured_grid);
  const auto compression = GENERATE(Compression::none, Compression::lz4, Compression::zlib);
  const auto particles = GENERATE(0, 1, 123, 20000);
  SeriesWriter writer(folder.path(), {format, compression});
  const std::vector<Frame> frames{example_frame(0, particles), example_frame(0.1, particles)};
  for (const auto& frame : frames) writer.write(frame);
  const auto series = open_series(writer.pvd());
  REQUIRE(series.frames.size() == 2);
  CHECK(series.frames[1].time == 0.1);
  for (int i = 0; i < 2; ++i) CHECK(same(frame_in(series.file(i)), frames[i]));
}

TEST_CASE("what is read has one vertex per particle") {
  const TemporaryFolder folder;
  written(folder, example_frame(), Compression::zlib);
  const auto data = read_frame(folder / "frames/particles_000000.vtp");
  CHECK(data->GetNumberOfVerts() == 123);
  CHECK(data->GetNumberOfCells() == 123);
}

TEST_CASE("files of other programs with raw data are read: 32-bit headers, single precision, no names") {
  const TemporaryFolder folder;
  const auto frame = example_frame();
  const auto data = view_of(frame);
  vtkNew<vtkFloatArray> array;
  array->SetName("Wave");
  array->SetNumberOfComponents(2);
  array->SetNumberOfTuples(123);
  array->Fill(0.5);
  data->GetPointData()->AddArray(array);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetHeaderTypeToUInt32();
  writer->EncodeAppendedDataOff();
  writer->SetFileName((folder / "other.vtp").c_str());
  REQUIRE(writer->Write() == 1);
  const auto read = frame_in(folder / "other.vtp");
  CHECK(read.points == frame.points);
  CHECK(read.fields.back().components == std::vector<std::string>{"0", "1"});
  CHECK(std::get<std::vector<double>>(read.fields.back().values) == std::vector<double>(246, 0.5));
}

TEST_CASE("files in VTK's other encodings are refused with a reason") {
  const TemporaryFolder folder;
  const auto frame = example_frame();
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(view_of(frame));
  writer->SetFileName((folder / "other.vtp").c_str());
  writer->SetDataModeToAscii();
  writer->Write();
  CHECK_THROWS_WITH(read_frame(folder / "other.vtp"), Contains("not appended"));
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOn();
  writer->Write();
  CHECK_THROWS_WITH(read_frame(folder / "other.vtp"), Contains("not raw"));
  writer->SetCompressorTypeToLZMA();
  writer->EncodeAppendedDataOff();
  writer->Write();
  CHECK_THROWS_WITH(read_frame(folder / "other.vtp"), Contains("vtkLZMADataCompressor"));
}

TEST_CASE("a frame file cut at any length is a ReadError") {
  const TemporaryFolder folder;
  const auto compression = GENERATE(Compression::none, Compression::lz4, Compression::zlib);
  const auto text = written(folder, example_frame(0, 20), compression);
  for (std::size_t length = 0; length < text.size() - 1; ++length) {  // the last byte is a line break
    put(folder / "cut.vtp", text.substr(0, length));
    CHECK_THROWS_AS(read_frame(folder / "cut.vtp"), ReadError);
  }
}

TEST_CASE("a frame file with bytes missing in the middle is a ReadError") {
  const TemporaryFolder folder;
  const auto compression = GENERATE(Compression::none, Compression::lz4, Compression::zlib);
  const auto text = written(folder, example_frame(0, 20), compression);
  const auto data = text.find("<AppendedData");
  for (std::size_t at = data / 2; at < data + 100; at += 3) {
    put(folder / "gap.vtp", text.substr(0, at) + text.substr(text.size() - 40));
    CHECK_THROWS_AS(read_frame(folder / "gap.vtp"), ReadError);
  }
}

TEST_CASE("damaged bytes give a ReadError or other values, never a crash") {
  const TemporaryFolder folder;
  const auto compression = GENERATE(Compression::none, Compression::lz4, Compression::zlib);
  const auto text = written(folder, example_frame(0, 20), compression);
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    auto damaged = text;
    for (int k = 0; k < 1 + i % 4; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
    put(folder / "damaged.vtp", damaged);
    try {
      frame_in(folder / "damaged.vtp");
    } catch (const ReadError&) {
      ++refused;
    }
  }
  CHECK(refused > 100);
}

TEST_CASE("sizes that the file cannot hold are refused before memory is asked for") {
  const TemporaryFolder folder;
  const auto text = written(folder, example_frame(0, 123), Compression::zlib);
  const auto reading = [&](const std::string& changed) {
    put(folder / "changed.vtp", changed);
    return read_frame(folder / "changed.vtp");
  };
  for (const std::string count :
       {"122", "124", "1000000", "99999999999999", "18446744073709551615", "-1", "x"}) {
    CHECK_THROWS_AS(reading(replaced(text, "NumberOfPoints=\"123", "NumberOfPoints=\"" + count)), ReadError);
  }
  for (const std::string count : {"0", "5", "7", "2147483648", "4611686018427387904"}) {
    CHECK_THROWS_AS(
        reading(replaced(text, "NumberOfComponents=\"6\"", "NumberOfComponents=\"" + count + "\"")),
        ReadError);
  }
  CHECK_THROWS_AS(reading(replaced(text, "type=\"Float64\"", "type=\"Float32\"")), ReadError);
  CHECK_THROWS_AS(reading(replaced(text, "type=\"Float64\"", "type=\"Float99\"")), ReadError);
  CHECK_THROWS_AS(reading(replaced(text, "byte_order=\"LittleEndian\"", "byte_order=\"BigEndian\"")),
                  ReadError);
  CHECK_THROWS_AS(reading(replaced(text, "offset=\"0\"", "offset=\"18446744073709551615\"")), ReadError);
  CHECK_THROWS_AS(reading(replaced(text, "Points>", "Dots>")), ReadError);
}

TEST_CASE("empty, foreign and nested files are ReadErrors that name the file") {
  const TemporaryFolder folder;
  std::string nested;
  for (int i = 0; i < 200000; ++i) nested += "<a>";
  for (const std::string text :
       {"", "\n", "</VTKFile>", "time,a\n0,1\n", "<?xml version=\"1.0\"?><html></html></VTKFile>",
        "<VTKFile type=\"ImageData\" byte_order=\"LittleEndian\"></VTKFile>",
        "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"></VTKFile>"}) {
    put(folder / "other.vtp", text);
    CHECK_THROWS_WITH(read_frame(folder / "other.vtp"), Contains("cannot read") && Contains("other.vtp: "));
  }
  put(folder / "other.vtp", nested + "</VTKFile>");
  CHECK_THROWS_AS(read_frame(folder / "other.vtp"), ReadError);
  CHECK_THROWS_WITH(read_frame(folder / "none.vtp"), Contains("No such file or directory"));
  CHECK_THROWS_AS(read_frame(folder.path()), ReadError);
}
