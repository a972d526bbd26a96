// Two commands that would write into one folder.
#include <catch2/catch.hpp>

#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("a folder is one process's at a time, and nobody's after a kill") {
  const Workplace place;
  place.write("small.toml", small_case);
  const std::string run = "'" POROSPH_PROGRAM "' run small.toml --quiet --checkpoint-every 0.01 --out run",
                    endless = run + " --set time.end=1e5 --set output.interval=10";
  // A second run of the same case, of another by force, and finite elements find the folder taken.
  const int killed = place.shell(
      endless +
      " & first=$!; while [ ! -e run/checkpoint.bin ]; do sleep 0.01; done; cp run/case.toml before.toml; " +
      endless + " --resume; echo $?; " + run +
      " --force; echo $?; '" POROSPH_PROGRAM
      "' fem small.toml --force --out run; echo $?; cmp before.toml run/case.toml && kill -0 $first && echo "
      "runs; "
      "kill -KILL $first; wait $first");
  CHECK(killed == 128 + 9);
  CHECK(text_of(place.folder() / "out") == "4\n4\n4\nruns\n");
  CHECK_THAT(text_of(place.folder() / "err"),
             Contains("porosph: cannot write run: another process computes into it"));
  CHECK(place.porosph("run small.toml --quiet --force --out run").status == 0);
}

TEST_CASE("finite elements do not write over another case's results") {
  const Workplace place;
  place.write("small.toml", small_case);
  REQUIRE(place.porosph("run small.toml --quiet --out run").status == 0);
  const std::string fem = "fem small.toml --edge 1 --out run";
  CHECK(place.porosph(fem).status == 0);  // the same case: beside the run's
  CHECK(fs::exists(place.folder() / "run/particles.pvd"));

  const std::string before = text_of(place.folder() / "run/case.toml");
  const Outcome refused = place.porosph(fem + " --set water.level=6");
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("run holds results of another case") && Contains("--force"));
  CHECK(text_of(place.folder() / "run/case.toml") == before);
  CHECK(fs::exists(place.folder() / "run/particles.pvd"));

  CHECK(place.porosph(fem + " --set water.level=6 --force").status == 0);
  CHECK_FALSE(fs::exists(place.folder() / "run/particles.pvd"));
  CHECK(fs::exists(place.folder() / "run/fem.vtu"));
  CHECK(place.porosph("run small.toml --quiet --force --out run").status == 0);
  CHECK_FALSE(fs::exists(place.folder() / "run/fem.vtu"));  // it was the other's
}

TEST_CASE("what is refused leaves no folder behind") {
  const Workplace place;
  place.write("small.toml", small_case);
  CHECK(place.porosph("run small.toml --out run --set particles.spacing=1e-9").status == 2);
  CHECK_FALSE(fs::exists(place.folder() / "run"));
}
