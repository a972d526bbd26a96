// Fields made for output, against what is known of simple states.
#include "solver/output/fields.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <sstream>

#include "solver/analysis/derived_fields.hpp"
#include "solver/output/boundary_frame.hpp"
#include "solver/output/invariants.hpp"
#include "solver/output/strain.hpp"
#include "solver/run/run.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

const std::vector<double>& values(const Frame& frame, const std::string& name) {
  for (const FrameField& field : frame.fields)
    if (field.name == name) return std::get<std::vector<double>>(field.values);
  throw std::runtime_error("no " + name);
}

Case submerged_column() {
  Case scene = box_of_soil(4, 8);
  hold_as_column(scene);
  add_water(scene, 5);
  scene.soils[0].unit_weight_unsaturated = scene.soils[0].unit_weight_saturated;
  scene.loading.damping = 0.05;
  scene.reference = Reference::column;
  return scene;
}

std::string documented_fields(const std::vector<Field>& fields = field_table()) {
  std::ostringstream table;
  table << "| field | components | unit | what |\n|---|---|---|---|\n";
  for (const Field& f : fields) {
    std::string components;
    for (const std::string& c : component_names(f.kind)) components += (components.empty() ? "" : " ") + c;
    table << "| `" << f.name << "` | " << components << " | " << f.unit << " | " << f.meaning << " |\n";
  }
  return table.str();
}

const std::string format_page = std::string(POROSPH_SOURCE_DIR) + "/docs/output-format.md";
const std::string table_begin = "<!-- fields -->\n", table_end = "<!-- end of fields -->\n";
const std::string derived_begin = "<!-- derived fields -->\n",
                  derived_end = "<!-- end of derived fields -->\n";

void write_between(std::string& page, const std::string& begin_mark, const std::string& end_mark,
                   const std::string& text) {
  const auto begin = page.find(begin_mark) + begin_mark.size(), end = page.find(end_mark);
  REQUIRE(end != std::string::npos);
  page.replace(begin, end - begin, text);
}

std::string contents(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  REQUIRE(stream);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("invariants of a known stress", "[output]") {
  const Stress s{-3e3, -9e3, -4e3, 4e3};  // in-plane: mean -6, radius 5
  const auto principal = principal_stresses(s);
  CHECK(principal[0] == Approx(-1e3));
  CHECK(principal[1] == Approx(-4e3));
  CHECK(principal[2] == Approx(-11e3));
  CHECK(deviator(s).mean() == Approx(0).margin(1e-9));
  CHECK(deviator(s).yy == Approx(-9e3 + 16e3 / 3));
  const double a = principal[0], b = principal[1], c = principal[2];
  CHECK(von_mises_stress(s) ==
        Approx(std::sqrt(0.5 * ((a - b) * (a - b) + (b - c) * (b - c) + (c - a) * (c - a)))));
  CHECK(von_mises_stress({-7, -7, -7, 0}) == Approx(0).margin(1e-12));
}

TEST_CASE("strain is exact for linear displacements and blind to rotation", "[output]") {
  Case scene = box_of_soil(6, 5);
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = 0.2;
  Model model = build_model(scene);
  const double angle = 0.4;
  const Mat2 turn =
      (Mat2() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
  const Mat2 stretch = (Mat2() << 1.02, 0.03, 0.03, 0.95).finished();
  const Mat2 f = turn * stretch;
  for (Vec2& x : model.particles.position) x = f * x + Vec2(3, -1);
  const Mat2 exact = 0.5 * (stretch * stretch - Mat2::Identity());
  for (const Strain& e : strain_since_start(model)) {
    CHECK(e.xx == Approx(exact(0, 0)).margin(1e-12));
    CHECK(e.yy == Approx(exact(1, 1)).margin(1e-12));
    CHECK(e.xy == Approx(exact(0, 1)).margin(1e-12));
    CHECK(e.zz == 0);
  }
}

TEST_CASE("in a frame the optional fields agree with the stress they are made of", "[output]") {
  Simulation simulation(submerged_column());
  for (int i = 0; i < 40; ++i) simulation.advance();
  std::vector<std::string> names = optional_field_names();
  names.push_back("EffectiveStress");
  const Frame frame = make_frame(simulation, names);
  REQUIRE(frame.fields.size() == names.size());
  const auto &stress = values(frame, "EffectiveStress"), &mean = values(frame, "MeanStress"),
             &deviatoric = values(frame, "DeviatoricStress"), &principal = values(frame, "PrincipalStress");
  for (std::size_t i = 0; i < mean.size(); ++i) {
    CHECK(deviatoric[6 * i + 1] + mean[i] == Approx(stress[6 * i + 1]));
    CHECK(principal[3 * i] + principal[3 * i + 1] + principal[3 * i + 2] == Approx(3 * mean[i]));
  }
  CHECK(make_frame(simulation, {"MeanStress"}).fields.size() == 1);
}

TEST_CASE("the excess over theory goes to zero as the soil comes to rest", "[output]") {
  Case scene = submerged_column();
  scene.time.end = 1;
  scene.time.courant = 0.8;
  scene.particles.spacing = 0.25;
  scene.loading.damping = 0.2;
  Simulation simulation(scene);
  const auto largest = [&](const char* field) {
    const Frame frame = make_frame(simulation, {field});
    double most = 0;
    for (const double x : values(frame, field)) most = std::max(most, std::abs(x));
    return most;
  };
  const double at_start = largest("ExcessStress");  // the soil is without stress: all of theory's
  run(simulation, {});
  CHECK(at_start == Approx(largest("EffectiveStress")).epsilon(0.05));
  CHECK(largest("ExcessStress") < 0.03 * at_start);
}

TEST_CASE("the boundary's particles lie behind its walls", "[output]") {
  Case scene = submerged_column();
  scene.formulation.motion = GENERATE(Motion::consistent, Motion::proposed);
  Simulation simulation(scene);
  for (int i = 0; i < 5; ++i) simulation.advance();
  const Frame frame = make_boundary_frame(simulation);
  const auto& fixed = std::get<std::vector<std::int32_t>>(frame.fields[1].values);
  const auto& boundary = std::get<std::vector<std::int32_t>>(frame.fields[0].values);
  REQUIRE(frame.points.size() == 3 * fixed.size());
  int below = 0;
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const double x = frame.points[3 * i], y = frame.points[3 * i + 1];
    CHECK((x < 0 || x > 2 || y < 0));
    CHECK((boundary[i] >= 0 && boundary[i] < 3));
    CHECK((fixed[i] == 1) == (boundary[i] == 0));
    below += y < 0 && x > 0 && x < 2;
  }
  CHECK(below == 4 * 2);  // rows at 0.25 and 0.75 m are within the support of 1.2 m, that at 1.25 m is not
}

TEST_CASE("frames are also due at given times", "[output]") {
  const Schedule schedule(0, 0.01, 100, {0.123, 0.5});
  std::vector<int> due;
  for (int step = 0; step <= 100; ++step)
    if (schedule.due(step)) due.push_back(step);
  CHECK(due == std::vector<int>{0, 12, 50, 100});
}

// After a change of fields: unit_solver "[.write-docs]" rewrites the table.
TEST_CASE("the documentation's tables of fields are up to date") {
  const std::string page = contents(format_page);
  CHECK(page.find(table_begin + documented_fields() + table_end) != std::string::npos);
  CHECK(page.find(derived_begin + documented_fields(derived_field_table()) + derived_end) !=
        std::string::npos);
}
TEST_CASE("write the documentation's tables of fields", "[.write-docs]") {
  std::string page = contents(format_page);
  write_between(page, table_begin, table_end, documented_fields());
  write_between(page, derived_begin, derived_end, documented_fields(derived_field_table()));
  std::ofstream(format_page) << page;
}
