#include <catch2/catch.hpp>

#include "tests/unit/vtk_io/example_frame.hpp"
#include "vtk_io/paraview_script.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

TEST_CASE("the script colours by the vertical effective stress") {
  const auto script = paraview_script("/a/b", "particles.pvd", example_frame());
  CHECK_THAT(script, Contains("SERIES = \"particles.pvd\"\n") && Contains("WRITTEN_IN = \"/a/b\"\n"));
  CHECK_THAT(script, Contains("FIELD = \"EffectiveStress\"\n") && Contains("COMPONENT = \"YY\"\n"));
}

TEST_CASE("without effective stress the script colours by the first field, or by none") {
  auto frame = example_frame();
  frame.fields = {field("PorePressure", {}, 123), field("Velocity", {"X", "Y", "Z"}, 123)};
  CHECK_THAT(paraview_script("", "a", frame), Contains("FIELD = \"PorePressure\"\nCOMPONENT = \"\"\n"));
  frame.fields.erase(frame.fields.begin());
  CHECK_THAT(paraview_script("", "a", frame), Contains("FIELD = \"Velocity\"\nCOMPONENT = \"X\"\n"));
  frame.fields.clear();
  CHECK_THAT(paraview_script("", "a", frame), Contains("FIELD = \"\"\n"));
}

TEST_CASE("names are quoted as Python text") {
  const auto script = paraview_script("/it's \"here\"\\\n{x}/ü", "a.pvd", example_frame());
  CHECK_THAT(script, Contains(R"(WRITTEN_IN = "/it's \"here\"\\\n{x}/ü")"));
}
