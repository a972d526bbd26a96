// porosph render: styles, marks, kinds of files.
#include <catch2/catch.hpp>
#include <regex>

#include "tests/app/porosph.hpp"
#include "tests/unit/render/image.hpp"

using namespace porosph;
using namespace porosph::render;
using Catch::Matchers::Contains;

TEST_CASE("a field is drawn in every style, with marks, on pixels and as lines") {
  const Workplace place;
  place.write("small.toml", small_case);
  REQUIRE(place.porosph("run small.toml --quiet --out run").status == 0);
  const auto draw = [&](const std::string& options, const std::string& file) {
    CAPTURE(options, file);
    const Outcome done = place.porosph("render run --field EffectiveStress:YY " + options + " --out " + file);
    CHECK(done.status == 0);
    CHECK(done.out == file + "\n");
    return text_of(place.folder() / file);
  };
  const std::string particles = draw("", "particles.png"), bands = draw("--style bands", "bands.png"),
                    isolines = draw("--style isolines", "isolines.png"),
                    crosses = draw("--style bands --crosses", "crosses.png"),
                    arrows = draw("--arrows Displacement --deform 40", "arrows.png");
  CHECK(particles != bands);
  CHECK(bands != isolines);
  CHECK(crosses != bands);
  CHECK(arrows != particles);
  CHECK(draw("--style bands", "again.png") == bands);
  CHECK(draw("--style bands", "a.svg") == draw("--style bands", "b.svg"));
  CHECK(draw("--style bands", "a.pdf") == draw("--style bands", "b.pdf"));
  CHECK(text_of(place.folder() / "a.svg").find("<image") == std::string::npos);
  CHECK(place.porosph("render run --field Displacement --style bands --time all --out film.webp").status ==
        0);
  const std::string film = text_of(place.folder() / "film.webp");
  CHECK(film.substr(8, 4) == "WEBP");
  const std::string pvd = text_of(place.folder() / "run/particles.pvd");
  const std::regex frame("<DataSet "), picture("ANMF");
  CHECK(std::distance(std::sregex_iterator(film.begin(), film.end(), picture), {}) ==
        std::distance(std::sregex_iterator(pvd.begin(), pvd.end(), frame), {}));
  CHECK(place.porosph("section run --vertical 1 --out s.pdf").status == 0);
  CHECK(text_of(place.folder() / "s.pdf").starts_with("%PDF"));
}

TEST_CASE("what cannot be drawn is refused") {
  const Workplace place;
  place.write("small.toml", small_case);
  REQUIRE(place.porosph("run small.toml --quiet --out run").status == 0);
  for (const auto& [options, message] : std::initializer_list<std::pair<const char*, const char*>>{
           {"--style contours", "--style = contours: must be particles, bands or isolines"},
           {"--arrows PorePressure",
            "--arrows = PorePressure: must be Displacement, Velocity, DarcyVelocity, HydraulicGradient"},
           {"--out a.jpg", "--out = a.jpg: the name must end in .png, .svg or .pdf"},
           {"--out a.webp", "--out = a.webp: a film needs --time all"},
           {"--time all --out a.webp --rate 0", "--rate = 0: must be from 0.1 to 60"}}) {
    CAPTURE(options);
    const Outcome refused = place.porosph(std::string("render run --field PorePressure ") + options);
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err, Contains(message));
  }
}
