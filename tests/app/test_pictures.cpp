// The pictures of README and docs that can be drawn in seconds, against what the program draws now.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <regex>

#include "tests/app/porosph.hpp"
#include "tests/unit/render/image.hpp"

using namespace porosph;
using namespace porosph::render;
namespace fs = std::filesystem;

namespace {

const fs::path shown = fs::path(POROSPH_SOURCE_DIR) / "docs/images";

struct DrawnPicture {
  std::string file;  ///< in docs/images
  fs::path drawn;
};

double last_time(const fs::path& pvd) {
  const std::string text = text_of(pvd);
  const std::regex time("timestep=\"([^\"]*)\"");
  double last = 0;
  for (std::sregex_iterator i(text.begin(), text.end(), time), end; i != end; ++i) last = std::stod((*i)[1]);
  return last;
}

/// Figure 3 as demo.sh makes it: two forms at the time at which one of them breaks down.
void draw_foundation(const Workplace& place) {
  const std::string run =
      "run '" POROSPH_SOURCE_DIR
      "/cases/foundation.toml' --quiet --threads 1 --set time.end=1 --set soil.0.no_tension=true ";
  REQUIRE(place.porosph(run + "--set formulation.motion=conventional --out conventional").status == 3);
  std::ostringstream time;
  time.precision(17);
  time << last_time(place.folder() / "conventional/particles.pvd");
  REQUIRE(place
              .porosph(run + "--set formulation.motion=proposed --out proposed --set 'output.times=[" +
                       time.str() + "]'")
              .status == 0);
  REQUIRE(place
              .porosph("compare conventional proposed --time common --field TotalStress:YY --out foundation "
                       "--label 'conventional, no tension' --label 'proposed, no tension'")
              .status == 0);
}

/// The tutorial's lines.
void draw_tutorial(const Workplace& place) {
  for (const char* line :
       {"init my_slope.toml", "run my_slope.toml --quiet --threads 1 --out results/my_slope",
        "render results/my_slope --field EffectiveStress:YY",
        "report results/my_slope --out results/my_slope_report",
        "run my_slope.toml --quiet --threads 1 --set water.level=5 --out results/drawn_down",
        "compare results/my_slope results/drawn_down --field EffectiveStress:YY --out results/drawdown"}) {
    CAPTURE(line);
    REQUIRE(place.porosph(line).status == 0);
  }
}

/// The tutorial of the levee, with its soils set on the command line.
void draw_levee(const Workplace& place) {
  std::string run = "run levee.toml --quiet --threads 1 --out results/levee";
  for (const char* setting :
       {"levee.cohesion=3 kPa", "levee.friction_angle=28 deg", "levee.permeability=1e-7 m/s",
        "clay.youngs_modulus=10 MPa", "clay.friction_angle=22 deg", "clay.permeability=1e-7 m/s",
        "sand.youngs_modulus=60 MPa", "sand.cohesion=0", "sand.friction_angle=33 deg",
        "sand.permeability=1e-4 m/s"})
    run += std::string(" --set 'soil.") + setting + "'";
  REQUIRE(place
              .porosph("import '" POROSPH_SOURCE_DIR
                       "/cases/drawings/levee.dxf' --skip frame --spacing 1 --out levee.toml")
              .status == 0);
  REQUIRE(place.porosph(run).status == 0);
  REQUIRE(
      place.porosph("render results/levee --field PorePressure --style bands --out results/levee_water.png")
          .status == 0);
}

/// The column of README, by the commands that stand there.
void draw_collapse(const Workplace& place) {
  for (const char* line :
       {"run '" POROSPH_SOURCE_DIR
        "/cases/column_collapse.toml' --quiet --threads 1 --out results/column_collapse",
        "render results/column_collapse --field PlasticStrain --time 0.1 --time 0.3 --time last"}) {
    CAPTURE(line);
    REQUIRE(place.porosph(line).status == 0);
  }
}

/// What fails under a footing on sand, by the commands of theory.md.
void draw_footing(const Workplace& place) {
  for (const char* line : {"run '" POROSPH_SOURCE_DIR
                           "/cases/loads/footing_weight.toml' --quiet --threads 1 --out results/footing",
                           "render results/footing --field PlasticStrain --range 0.03,20"}) {
    CAPTURE(line);
    REQUIRE(place.porosph(line).status == 0);
  }
}

/// Loose sand before, while and after it has liquefied, by the commands of shaking.md.
void draw_liquefaction(const Workplace& place) {
  for (const char* line :
       {"run '" POROSPH_SOURCE_DIR
        "/cases/failure/liquefaction.toml' --quiet --threads 1 --out results/liquefaction",
        "render results/liquefaction --field PorePressureRatio --time 2 --time 6 --time 15 "
        "--time 25"}) {
    CAPTURE(line);
    REQUIRE(place.porosph(line).status == 0);
  }
}

std::vector<DrawnPicture> draw_all(const Workplace& place) {
  draw_foundation(place);
  draw_collapse(place);
  draw_tutorial(place);
  draw_levee(place);
  draw_footing(place);
  draw_liquefaction(place);
  const fs::path& f = place.folder();
  return {{"foundation.png", f / "foundation/TotalStress_YY.png"},
          {"column_collapse.png", f / "results/column_collapse/PlasticStrain.png"},
          {"tutorial_stress.png", f / "results/my_slope/EffectiveStress_YY.png"},
          {"tutorial_history.png", f / "results/my_slope_report/history.png"},
          {"tutorial_drawdown.png", f / "results/drawdown/EffectiveStress_YY.png"},
          {"tutorial_levee_water.png", f / "results/levee_water.png"},
          {"footing_on_sand.png", f / "results/footing/PlasticStrain.png"},
          {"liquefaction.png", f / "results/liquefaction/PorePressureRatio.png"}};
}

/// Of red, green and blue over all pixels, of 255.
double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a.at(x, y)[c] - b.at(x, y)[c]);
  return sum / (3. * a.width() * a.height());
}

}  // namespace

TEST_CASE("README and docs show what the program draws") {
  const Workplace place;
  for (const DrawnPicture& picture : draw_all(place)) {
    CAPTURE(picture.file);
    const Image now(picture.drawn), then(shown / picture.file);
    CHECK(now.width() == then.width());
    CHECK(now.height() == then.height());
    if (now.width() == then.width() && now.height() == then.height())
      CHECK(mean_difference(now, then) < 0.3);  // a moved label: 0.7; two times in one picture: 4.8
  }
}

TEST_CASE("the pictures of README and docs are drawn again", "[.redraw]") {
  const Workplace place;
  for (const DrawnPicture& picture : draw_all(place))
    fs::copy_file(picture.drawn, shown / picture.file, fs::copy_options::overwrite_existing);
}
