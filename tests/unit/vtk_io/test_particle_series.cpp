#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/unit/run_folder/temporary_folder.hpp"
#include "tests/unit/vtk_io/example_frame.hpp"
#include "vtk_io/particle_series.hpp"
#include "vtk_io/pvd.hpp"
#include "vtk_io/read_series.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

namespace {

/// What VTK's own reader, and so ParaView, sees in a file.
template <typename Reader>
vtkSmartPointer<vtkPointSet> seen_by_vtk(const std::filesystem::path& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

template <typename Array, typename Value>
void check_values(vtkDataArray* array, const std::vector<Value>& expected) {
  auto* values = Array::FastDownCast(array);
  REQUIRE(values != nullptr);
  REQUIRE(values->GetNumberOfValues() == static_cast<vtkIdType>(expected.size()));
  CHECK(std::equal(expected.begin(), expected.end(), values->GetPointer(0)));
}

void check_field(vtkDataArray* array, const FrameField& expected) {
  REQUIRE(array != nullptr);
  CHECK(array->GetNumberOfComponents() == expected.width());
  for (int c = 0; c < static_cast<int>(expected.components.size()); ++c) {
    REQUIRE(array->GetComponentName(c) != nullptr);
    CHECK(array->GetComponentName(c) == expected.components[c]);
  }
  if (const auto* values = std::get_if<std::vector<double>>(&expected.values)) {
    check_values<vtkDoubleArray>(array, *values);
  } else {
    check_values<vtkIntArray>(array, std::get<std::vector<std::int32_t>>(expected.values));
  }
}

void check_frame(vtkPointSet& data, const Frame& expected) {
  const auto particles = static_cast<vtkIdType>(expected.points.size() / 3);
  check_values<vtkDoubleArray>(data.GetPoints()->GetData(), expected.points);
  REQUIRE(data.GetNumberOfCells() == particles);
  for (vtkIdType i = 0; i < particles; ++i) {
    REQUIRE(data.GetCellType(i) == VTK_VERTEX);
    REQUIRE(data.GetCell(i)->GetPointId(0) == i);
  }
  CHECK(data.GetPointData()->GetNumberOfArrays() == static_cast<int>(expected.fields.size()));
  for (const auto& field : expected.fields) {
    check_field(data.GetPointData()->GetArray(field.name.c_str()), field);
  }
  check_values<vtkDoubleArray>(data.GetFieldData()->GetArray("TimeValue"),
                               std::vector<double>{expected.time});
  CHECK(data.GetFieldData()->GetArray("Step")->GetComponent(0, 0) == static_cast<double>(expected.step));
}

std::vector<std::string> sorted_names_in(const std::filesystem::path& folder) {
  auto names = names_in(folder);
  std::ranges::sort(names);
  return names;
}

}  // namespace

TEST_CASE("VTK's reader finds in a .vtp what the frame holds, bit for bit") {
  const TemporaryFolder folder;
  const auto compression = GENERATE(Compression::none, Compression::lz4, Compression::zlib);
  const auto particles = GENERATE(0, 1, 123, 20000);
  const auto frame = example_frame(0.1, particles);
  SeriesWriter(folder.path(), {FrameFormat::poly_data, compression}).write(frame);
  check_frame(*seen_by_vtk<vtkXMLPolyDataReader>(folder / "frames/particles_000000.vtp"), frame);
}

TEST_CASE("VTK's reader finds in a .vtu what the frame holds, bit for bit") {
  const TemporaryFolder folder;
  const auto compression = GENERATE(Compression::none, Compression::lz4, Compression::zlib);
  const auto frame = example_frame(0.1);
  SeriesWriter(folder.path(), {FrameFormat::unstructured_grid, compression}).write(frame);
  check_frame(*seen_by_vtk<vtkXMLUnstructuredGridReader>(folder / "frames/particles_000000.vtu"), frame);
}

TEST_CASE("single precision halves the fields and rounds them, and leaves points and numbers as they are") {
  const TemporaryFolder folder;
  const auto format = GENERATE(FrameFormat::poly_data, FrameFormat::unstructured_grid);
  const auto frame = example_frame(0.1, 1000);
  const auto written = [&](const char* name, FramePrecision precision) {
    SeriesWriter(folder / name, {format, Compression::none, precision}).write(frame);
    const auto frames = folder / name / "frames";
    return frames / names_in(frames).at(0);
  };
  const auto full = written("full", FramePrecision::full), single = written("single", FramePrecision::single);
  const auto data = read_frame(single);
  check_values<vtkDoubleArray>(data->GetPoints()->GetData(), frame.points);
  std::size_t saved = 0;
  for (const FrameField& field : frame.fields) {
    CAPTURE(field.name);
    auto* array = data->GetPointData()->GetArray(field.name.c_str());
    REQUIRE(array != nullptr);
    const auto* values = std::get_if<std::vector<double>>(&field.values);
    if (values == nullptr) {
      check_field(array, field);
      continue;
    }
    const std::vector<float> rounded(values->begin(), values->end());
    check_values<vtkFloatArray>(array, rounded);
    saved += 4 * values->size();
    CHECK(array->GetNumberOfComponents() == field.width());
  }
  REQUIRE(saved > 0);
  CHECK(file_size(full) - file_size(single) == Approx(static_cast<double>(saved)).margin(64));
}

TEST_CASE("a frame says of which case it is") {
  const TemporaryFolder folder;
  const std::string text = "title = \"Dam — ä\"\n[particles]\nspacing = 0.5\n";
  SeriesOptions options;
  options.case_text = text;
  SeriesWriter(folder.path(), options).write(example_frame());
  const auto file = folder / "frames/particles_000000.vtp";
  const auto data = seen_by_vtk<vtkXMLPolyDataReader>(file);
  auto* kept = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("Case"));
  REQUIRE(kept != nullptr);
  CHECK(kept->GetValue(0) == text);
  CHECK(read_frame(file)->GetNumberOfPoints() == data->GetNumberOfPoints());
}

TEST_CASE("files are raw, compressed and have 64-bit headers") {
  const TemporaryFolder folder;
  SeriesWriter(folder.path()).write(example_frame());
  const auto text = content(folder / "frames/particles_000000.vtp");
  CHECK_THAT(text, Contains("header_type=\"UInt64\"") && Contains("compressor=\"vtkZLibDataCompressor\""));
  CHECK_THAT(text, Contains("<AppendedData encoding=\"raw\">"));
}

TEST_CASE("after each frame the .pvd names all of them, with exact times") {
  const TemporaryFolder folder;
  SeriesWriter series(folder.path());
  const std::vector<double> times{0, 1e-9, 0.1, 0.1 + 0.2, 1.0 / 3, 12345.678901234567};
  for (std::size_t i = 0; i < times.size(); ++i) {
    series.write(example_frame(times[i]));
    const auto frames = read_pvd(series.pvd());
    REQUIRE(frames.size() == i + 1);
    CHECK(frames[i].time == times[i]);
    CHECK(std::filesystem::exists(folder / frames[i].file));
  }
  CHECK(read_pvd(series.pvd())[5].file == "frames/particles_000005.vtp");
  CHECK(sorted_names_in(folder.path()) ==
        std::vector<std::string>{"compare_in_paraview.py", "frames", "open_in_paraview.py", "particles.pvd"});
  CHECK(names_in(folder / "frames").size() == times.size());
}

TEST_CASE("two series in two folders do not meet") {
  const TemporaryFolder folder;
  SeriesWriter a(folder / "deep/a"), b(folder / "deep/b", {FrameFormat::unstructured_grid, Compression::lz4});
  for (const double time : {0.0, 0.5}) {
    a.write(example_frame(time));
    b.write(example_frame(2 * time, 7));
  }
  CHECK(read_pvd(a.pvd())[1].time == 0.5);
  CHECK(read_pvd(b.pvd())[1].time == 1.0);
  CHECK(
      seen_by_vtk<vtkXMLPolyDataReader>(folder / "deep/a/frames/particles_000001.vtp")->GetNumberOfPoints() ==
      123);
  CHECK(seen_by_vtk<vtkXMLUnstructuredGridReader>(folder / "deep/b/frames/particles_000001.vtu")
            ->GetNumberOfPoints() == 7);
}

TEST_CASE("a new series takes the place of an older, longer one, and leaves other files alone") {
  const TemporaryFolder folder;
  SeriesWriter older(folder.path(), {FrameFormat::unstructured_grid, Compression::zlib});
  for (const double time : {0.0, 0.1, 0.2}) older.write(example_frame(time));
  put(folder / "frames/notes.txt", "mine");
  SeriesWriter newer(folder.path());
  newer.write(example_frame(0));
  newer.write(example_frame(0.4));
  CHECK(sorted_names_in(folder / "frames") ==
        std::vector<std::string>{"notes.txt", "particles_000000.vtp", "particles_000001.vtp"});
}

TEST_CASE("a resumed series continues after the given time") {
  const TemporaryFolder folder;
  std::vector<std::uint32_t> checksums;
  {
    SeriesWriter series(folder.path());
    for (const double time : {0.0, 0.1}) series.write(example_frame(time));
    checksums = series.checksums();
    for (const double time : {0.2, 0.3}) series.write(example_frame(time));
  }
  auto series = SeriesWriter::resume(folder.path(), 0.1, checksums);
  CHECK(read_pvd(series.pvd()).size() == 2);
  CHECK(names_in(folder / "frames").size() == 2);
  series.write(example_frame(0.15, 9));
  const auto frames = read_pvd(series.pvd());
  REQUIRE(frames.size() == 3);
  CHECK(frames[2].time == 0.15);
  CHECK(frames[2].file == "frames/particles_000002.vtp");
  CHECK(seen_by_vtk<vtkXMLPolyDataReader>(folder / frames[2].file)->GetNumberOfPoints() == 9);
  CHECK_THROWS_WITH(SeriesWriter::resume(folder.path(), 0.12, checksums), Contains("no frame at 0.12 s"));
  CHECK_THROWS_AS(SeriesWriter::resume(folder / "none", 0, {}), ReadError);
}

TEST_CASE("a series that was changed is not resumed") {
  const TemporaryFolder folder;
  SeriesWriter series(folder.path());
  for (const double time : {0.0, 0.1, 0.2}) series.write(example_frame(time));
  const auto checksums = series.checksums();
  const auto frame = folder / "frames/particles_000001.vtp";
  const std::string sound = content(frame), pvd = content(series.pvd());
  SECTION("an edited frame") {
    std::string edited = sound;
    edited[edited.size() / 2] = static_cast<char>(edited[edited.size() / 2] ^ 1);
    put(frame, edited);
    CHECK_THROWS_WITH(SeriesWriter::resume(folder.path(), 0.2, checksums),
                      Contains("particles_000001.vtp: it is not the file that the run wrote"));
  }
  SECTION("a cut frame") {
    put(frame, sound.substr(0, sound.size() - 1));
    CHECK_THROWS_WITH(SeriesWriter::resume(folder.path(), 0.2, checksums), Contains("particles_000001.vtp"));
  }
  SECTION("a frame that is gone") {
    std::filesystem::remove(frame);
    CHECK_THROWS_WITH(SeriesWriter::resume(folder.path(), 0.2, checksums), Contains("particles_000001.vtp"));
  }
  SECTION("a frame that is not listed any more") {
    auto frames = series.frames();
    frames.erase(frames.begin() + 1);
    put(series.pvd(), pvd_text(frames));
    CHECK_THROWS_WITH(SeriesWriter::resume(folder.path(), 0.2, checksums),
                      Contains("it names 2 files up to 0.2 s, and the run wrote 3"));
    CHECK(names_in(folder / "frames").size() == 3);
  }
  put(frame, sound), put(series.pvd(), pvd);
  CHECK(SeriesWriter::resume(folder.path(), 0.2, checksums).frames().size() == 3);
}

TEST_CASE("inconsistent frames are refused, and the series continues") {
  const TemporaryFolder folder;
  SeriesWriter series(folder.path());
  series.write(example_frame(1));
  CHECK_THROWS_WITH(series.write(example_frame(0.5)), Contains("time 0.5 after 1"));
  auto narrow = example_frame(2);
  narrow.fields[1].components.pop_back();
  CHECK_THROWS_WITH(series.write(narrow), Contains("'EffectiveStress'") && Contains("123 particles"));
  auto twice = example_frame(2);
  twice.fields[0].name = "PorePressure";
  CHECK_THROWS_WITH(series.write(twice), Contains("'PorePressure'"));
  auto odd = example_frame(2);
  odd.points.pop_back();
  CHECK_THROWS_AS(series.write(odd), std::invalid_argument);
  series.write(example_frame(2));
  CHECK(read_pvd(series.pvd()).size() == 2);
  CHECK(names_in(folder / "frames").size() == 2);
}

TEST_CASE("on a full disk there is one message, and the series is as it was before the frame") {
  const TemporaryFolder folder;
  const auto format = GENERATE(FrameFormat::poly_data, FrameFormat::unstructured_grid);
  const auto compression = GENERATE(Compression::none, Compression::zlib);
  SeriesWriter series(folder.path(), {format, compression});
  series.write(example_frame(0, 2000));
  const auto before = content(series.pvd());
  const auto size = std::filesystem::file_size(folder / series.frames()[0].file);
  for (const double part : {0.0, 0.01, 0.3, 0.6, 0.9, 0.999}) {
    const FileSizeLimit limit(static_cast<rlim_t>(part * static_cast<double>(size)));
    CHECK_THROWS_WITH(series.write(example_frame(0.1, 2000)),
                      Contains("cannot write") && Contains("particles_000001.vt"));
  }
  CHECK(content(series.pvd()) == before);
  CHECK(names_in(folder / "frames").size() == 1);
  series.write(example_frame(0.1, 2000));
  CHECK(read_pvd(series.pvd()).size() == 2);
}

TEST_CASE("a disk that is full at the last byte is noticed") {
  const TemporaryFolder folder;
  SeriesWriter series(folder.path());
  series.write(example_frame(0));
  const auto size = std::filesystem::file_size(folder / series.frames()[0].file);
  for (rlim_t missing = 1; missing < 40; ++missing) {
    const FileSizeLimit limit(size - missing);
    CHECK_THROWS_AS(series.write(example_frame(0)), WriteError);
  }
  CHECK(names_in(folder / "frames").size() == 1);
}

TEST_CASE("the boundary is a second block of the same times, kept and removed with its frames") {
  const TemporaryFolder folder;
  std::vector<std::uint32_t> checksums;
  {
    SeriesWriter series(folder.path());
    for (const double time : {0.0, 0.1}) series.write(example_frame(time), example_frame(time, 7));
    checksums = series.checksums();
    series.write(example_frame(0.2), example_frame(0.2, 7));
  }
  CHECK(std::filesystem::exists(folder / "frames/boundary_000002.vtp"));
  const auto series = SeriesWriter::resume(folder.path(), 0.1, checksums);
  CHECK_FALSE(std::filesystem::exists(folder / "frames/boundary_000002.vtp"));
  const auto frames = read_pvd(series.pvd());
  REQUIRE(frames.size() == 2);
  CHECK(frames[1].time == 0.1);
  CHECK(frames[1].file == "frames/particles_000001.vtp");
  CHECK(frames[1].boundary_file == "frames/boundary_000001.vtp");
  CHECK(read_frame(folder / frames[1].boundary_file)->GetNumberOfPoints() == 7);
}

TEST_CASE("folders that cannot be written are WriteErrors with the system's reason") {
  const TemporaryFolder folder;
  put(folder / "file", "");
  CHECK_THROWS_WITH(SeriesWriter(folder / "file"), Contains("Not a directory"));
  SeriesWriter series(folder / "series");
  {
    const ReadOnly read_only(folder / "series/frames");
    CHECK_THROWS_WITH(series.write(example_frame()),
                      Contains("particles_000000.vtp") && Contains("Permission denied"));
  }
  std::filesystem::remove_all(folder / "series");
  CHECK_THROWS_WITH(series.write(example_frame()), Contains("No such file or directory"));
}
