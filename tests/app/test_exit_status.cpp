#include <catch2/catch.hpp>

#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

TEST_CASE("help and version are answered with status 0") {
  const Workplace place;
  CHECK(place.porosph("--help").status == 0);
  CHECK_THAT(place.porosph("--version").out, Contains("porosph "));
  for (const std::string command : {"run", "check", "fem", "render", "compare", "report"}) {
    CAPTURE(command);
    const Outcome outcome = place.porosph(command + " --help");
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Contains("Usage: porosph " + command) && Contains("Examples:"));
  }
}

TEST_CASE("a wrong command line ends with status 2 and says what is wrong") {
  const Workplace place;
  place.write("small.toml", small_case);
  const auto [arguments, message] = GENERATE(table<std::string, std::string>({
      {"", "Usage:"},
      {"draw", "'draw' is not a subcommand"},
      {"run", "case"},
      {"run small.toml --thread 1", "--thread"},
      {"run small.toml --threads 0", "--threads = 0"},
      {"run small.toml --set particles.spacing=-1", "must be > 0"},
      {"run small.toml --set particle.spacing=1", "particle"},
      {"run absent.toml", "absent.toml"},
      {"fem small.toml --edge 0", "--edge = 0"},
      {"render somewhere", "--field"},
      {"compare one", "two runs are compared, not 1"},
      {"report one --leave-out 1,2", "X,Y,RADIUS"},
      {"report one --leave-out 1,2,-1", "radius must be > 0"},
      {"report one --fail-if errors", "PATH>NUMBER"},
      {"report one --fail-if 'errors>many'", "PATH>NUMBER"},
  }));
  CAPTURE(arguments);
  const Outcome outcome = place.porosph(arguments);
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains(message));
  CHECK(outcome.out.empty());
}

TEST_CASE("a run that becomes unstable ends with status 3 and keeps its files") {
  const Workplace place;
  place.write("small.toml", small_case);
  const Outcome outcome = place.porosph("run small.toml --out run --quiet --set time.courant=3");
  CHECK(outcome.status == 3);
  CHECK_THAT(outcome.err, Contains("unstable"));
  CHECK_THAT(text_of(place.folder() / "run/summary.json"), Contains("\"unstable\""));
  CHECK(place.porosph("render run --field PorePressure --time 0 --out p.png").status == 0);
}

TEST_CASE("files that cannot be read or written end with status 4") {
  const Workplace place;
  place.write("small.toml", small_case);
  place.write("file", "no folder");
  CHECK(place.porosph("run small.toml --quiet --out file/run").status == 4);
  for (const std::string arguments :
       {"render absent.pvd --field PorePressure", "render small.toml --field PorePressure",
        "compare absent absent", "report absent"}) {
    CAPTURE(arguments);
    const Outcome outcome = place.porosph(arguments);
    CHECK(outcome.status == 4);
    CHECK_THAT(outcome.err, Contains("cannot read"));
  }
}
