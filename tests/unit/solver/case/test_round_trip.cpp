#include <fstream>
#include <iterator>
#include <random>

#include "solver/output/fields.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/unit/solver/case/case_text.hpp"

using namespace porosph;
using namespace porosph::test;

namespace {

std::string contents(const std::string& file) {
  std::ifstream stream(std::string(POROSPH_SOURCE_DIR) + "/" + file, std::ios::binary);
  REQUIRE(stream);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool same(const Case& a,
          const Case& b) {  // every key that differs shows in the text, doubles to the last bit
  return write_case(a) == write_case(b);
}

// A case in which nothing has its default value.
Case unusual_case() {
  Case c;
  c.title = "Ünusual \"quoted\" \\ two lines 'x'";
  c.particles = {0.1 + 0.2, 1.0 / 0.9, Arrangement::disordered, 1.0 / 3, 77};
  SoilCase sand{"sand",
                {{0, 0}, {4, 0}, {4, 3}, {0, 3}},
                {{{1, 1}, {2, 1}, {1.5, 2}}},
                1e6 / 3,
                -0.1,
                2e4 / 7,
                1e4 / 7,
                true,
                Point(0.1, -1e-17),
                0.3,
                0};
  SoilCase clay = sand;
  clay.name = "clay";
  clay.polygon = {{4, 0}, {4, 3}, {8, 3}, {8, 0}};
  clay.holes.clear();
  clay.bending_velocity = 0.7;
  c.soils = {sand, clay};
  c.water.unit_weight = 1e4 / 3;
  c.water.stretches = {{-never, 1, 2}, {1, 3.3, 1.1}, {5, never, -0.7}};
  c.boundaries = {{BoundaryKind::roller, {0, 0}, {0, 5}}, {BoundaryKind::fixed, {8, 0}, {0, 0}}};
  c.formulation = {Motion::consistent, false, 0.3, 0.2, 0.1, 1e-7, 0.011, 0.07, 0.0123, true};
  c.loading = {9.8065, true, true, 0.7, 0.001, false, false, true, 1.0 / 7};
  c.time = {1.0 / 3, 0.9};
  c.stop = {1e-5, false};
  c.check = {.finite_elements = false, .finite_elements_auto = false};
  c.output = {0.01,
              {1.0 / 7, 0.2},
              0.001,
              {"Velocity", "Strain"},
              true,
              FrameFormat::unstructured_grid,
              Compression::lz4,
              FramePrecision::single};
  c.probes = {{"A", {3, 0.5}}, {"b-2_x", {7, 1}}};
  return c;
}

}  // namespace

TEST_CASE("a written case reads as the same case") {
  const Case c = unusual_case();
  const Case back = parse_case(write_case(c), "written");
  CHECK(same(back, c));
  CHECK(back.title == c.title);
  CHECK(back.particles.spacing == c.particles.spacing);
  CHECK(back.particles.seed == 77);
  CHECK(back.soils[0].holes == c.soils[0].holes);
  CHECK(back.soils[0].velocity == c.soils[0].velocity);
  CHECK(back.soils[1].youngs_modulus == c.soils[1].youngs_modulus);
  CHECK(back.water.stretches.size() == 3);
  CHECK(back.water.stretches[0].x_from == -never);
  CHECK(back.water.stretches[1].x_to == 3.3);
  CHECK(back.formulation.zero_energy_stiffness == 0.07);
  CHECK(back.formulation.refresh_strain == 0.0123);
  CHECK_FALSE(back.formulation.kernel_correction);
  CHECK(back.loading.k0 == 0.7);
  CHECK(back.loading.damping_until == 1.0 / 7);
  CHECK(back.output.fields == c.output.fields);
  CHECK(back.output.times == c.output.times);
  CHECK(back.output.boundary);
  CHECK(back.output.format == FrameFormat::unstructured_grid);
  CHECK(back.output.compression == Compression::lz4);
  CHECK(back.output.precision == FramePrecision::single);
  CHECK(back.probes[1].position == Point(7, 1));
}

TEST_CASE("water that flows is read, written and read as the same") {
  std::string text = small_case;
  const std::string retention =
      GENERATE(as<std::string>(), "{ model = 'van_genuchten', alpha = 2, n = 1.5, residual = 0.1 }",
               "{ model = 'table', saturation = [[0, 1], [1, 0.2]], permeability = [[0, 1], [1, 1e-3]] }");
  text.insert(text.find("poissons_ratio"),
              "permeability = 1e-5\nvelocity = [0, 0.5]\nretention = " + retention + "\n");
  text +=
      "\n[water]\nmode = 'transient'\nstart_level = 0.25\nrigid_soil = true\n"
      "[[water.face]]\nkind = 'closed'\n[[water.face]]\nkind = 'rain'\nrate_over_time = [[0, 0], [60, "
      "1e-6]]\n"
      "from = [0, 2]\nto = [4, 2]\n[[water.drain]]\nname = 'well'\nfrom = [0.5, 0.5]\nlevel = 0.3\nradius = "
      "0.01\n"
      "[[section]]\nname = 'middle'\nfrom = [0.5, 0]\nto = [0.5, 2]\n";
  const Case c = parse_case(text, "box.toml");
  const Case back = parse_case(write_case(c), "written");
  CHECK(same(back, c));
  CHECK(back.soils[0].velocity == Point(0, 0.5));
  CHECK(back.soils[0].retention.model == c.soils[0].retention.model);
  CHECK(back.water.transient.start_level == 0.25);
  CHECK(back.water.faces[1].rate_over_time.size() == 2);
  CHECK(back.water.drains[0].level == 0.3);
  CHECK(back.water.drains[0].radius == 0.01);
  CHECK(back.sections[0].to == Point(0.5, 2));
}

TEST_CASE("the strength of a soil is read, written and read as the same") {
  const std::string law = GENERATE(
      as<std::string>(),
      "law = 'mohr_coulomb'\ncohesion = 5e3\nfriction_angle = 30\ndilation_angle = 7\ndilation_limit = 0.07\n"
      "tensile_strength = 1e3\nsoftening = 'linear'\nsoftening_strain = 0.1\n"
      "softening_length = 0.4\nresidual_cohesion = 1e3\n",
      "law = 'drucker_prager'\ncohesion = 0\nfriction_angle = 19.8\n",
      "law = 'tresca'\nundrained_strength = 20e3\nundrained_strength_growth = 1.3e3\n"
      "undrained_strength_level = 1.5\nsoftening = 'exponential'\nsoftening_strain = 0.2\n"
      "softening_length = 0.5\nsensitivity = 3\n");
  std::string text = small_case;
  text.insert(text.find("poissons_ratio"), law);
  const Case c = parse_case(text, "box.toml");
  CHECK(same(parse_case(write_case(c), "written"), c));
  const StrengthCase& s = c.soils[0].strength;
  if (c.soils[0].law == LawKind::mohr_coulomb) {
    CHECK(s.residual_friction_angle == 30);
    CHECK(s.dilation_limit == 0.07);
    CHECK(s.tensile_strength == 1e3);
  }
  if (c.soils[0].law == LawKind::drucker_prager) CHECK(s.tensile_strength == never);
  if (c.soils[0].law == LawKind::tresca) {
    CHECK(s.level == 1.5);
    CHECK(s.sensitivity == 3);
  }
}

TEST_CASE("what is not given has its default, and stays so when written") {
  const Case c = parse_case(small_case, "box.toml");
  CHECK(c.particles.smoothing_ratio == 1);
  CHECK(c.soils[0].unit_weight_unsaturated == 20e3);
  CHECK_FALSE(c.water.present());
  CHECK(c.loading.k0 < 0);
  CHECK(c.loading.damping_until == never);
  CHECK(c.output.fields == OutputCase{}.fields);
  CHECK(c.reference == Reference::none);
  CHECK(same(parse_case(write_case(c), "written"), c));
  CHECK_FALSE(parse_case(write_case(c), "written").water.present());
}

TEST_CASE("whether inertia is scaled is a truth or auto, where damping is adaptive") {
  const std::string table = small_case + "[loading]\ndamping = 'adaptive'\n";
  CHECK(parse_case(table, "box.toml").loading.scaled_inertia_auto);
  for (const bool wanted : {true, false}) {
    const Case scene = parse_case(table + "scaled_inertia = " + (wanted ? "true\n" : "false\n"), "box.toml");
    CHECK_FALSE(scene.loading.scaled_inertia_auto);
    CHECK(scene.loading.scaled_inertia == wanted);
    CHECK(same(parse_case(write_case(scene), "written"), scene));
  }
  CHECK_FALSE(parse_case(write_case(parse_case(table, "box.toml")), "written", {"loading.damping=0.1"})
                  .loading.adaptive_damping);
  CHECK_THROWS_WITH(
      parse_case(table + "damping_until = 1\nscaled_inertia = true\n", "box.toml"),
      Catch::Matchers::Contains("key 'loading.scaled_inertia' = true: is not possible: it is for "
                                "loading.damping = \"adaptive\" until the end"));
}

TEST_CASE("whether finite elements are used is a truth or auto") {
  CHECK(parse_case(small_case, "box.toml").check.finite_elements_auto);
  const std::string table = small_case + "[check]\nfinite_elements = ";
  CHECK(parse_case(table + "'auto'\n", "box.toml").check.finite_elements_auto);
  for (const bool wanted : {true, false}) {
    const Case scene = parse_case(table + (wanted ? "true\n" : "false\n"), "box.toml");
    CHECK_FALSE(scene.check.finite_elements_auto);
    CHECK(scene.check.finite_elements == wanted);
    CHECK(same(parse_case(write_case(scene), "written"), scene));
    CHECK(
        parse_case(write_case(scene), "written", {"check.finite_elements=auto"}).check.finite_elements_auto);
  }
  CHECK_THROWS_WITH(
      parse_case(table + "'auot'\n", "box.toml"),
      Catch::Matchers::Contains(
          "key 'check.finite_elements' = \"auot\": must be true, false or \"auto\"; did you mean "
          "'auto'?"));
  CHECK_THROWS_WITH(parse_case(table + "1\n", "box.toml"),
                    Catch::Matchers::Contains("must be true, false or \"auto\""));
}

TEST_CASE("damping is a number or adaptive") {
  const Case adaptive = parse_case(small_case + "[loading]\ndamping = 'adaptive'\n", "box.toml");
  CHECK(adaptive.loading.adaptive_damping);
  CHECK(same(parse_case(write_case(adaptive), "written"), adaptive));
  CHECK(parse_case(write_case(adaptive), "written").loading.adaptive_damping);
  CHECK_FALSE(parse_case(write_case(adaptive), "written", {"loading.damping=0.1"}).loading.adaptive_damping);
  CHECK(parse_case(small_case, "box.toml", {"loading.damping=adaptive"}).loading.adaptive_damping);
  CHECK(errors_with("[loading]\ndamping = 'adaptiv'\n") ==
        "box.toml:21:11: key 'loading.damping' = \"adaptiv\": must be a number >= 0 and <= 1 or "
        "\"adaptive\"; did "
        "you mean 'adaptive'?");
  CHECK(errors_with("[loading]\ndamping = true\n") ==
        "box.toml:21:11: key 'loading.damping' = true: must be a number, or text of a number and a unit; "
        "allowed are %");
}

TEST_CASE("each momentum form brings its own artificial terms") {
  const FormulationCase usual = parse_case(small_case, "box.toml").formulation;
  CHECK(usual.motion == Motion::consistent);
  CHECK(usual.artificial_viscosity_alpha == 0);
  CHECK(usual.artificial_stress == 0);
  CHECK(usual.bulk_viscosity == -1);
  CHECK(usual.zero_energy_control == 0.2);
  CHECK(usual.refresh_strain < 0);  // by what is there
  for (const Motion motion : {Motion::conventional, Motion::proposed, Motion::rho_squared}) {
    const std::string set = "formulation.motion=" + std::string(motion_name(motion));
    const Case c = parse_case(small_case, "box.toml", {set});
    CHECK(c.formulation.motion == motion);
    CHECK(c.formulation.artificial_viscosity_alpha == 0.1);
    CHECK(c.formulation.artificial_stress == 0);
    CHECK(c.formulation.bulk_viscosity == 0);
    CHECK(c.formulation.zero_energy_control == 0);
    CHECK(c.formulation.refresh_strain == 0);
    CHECK(same(parse_case(write_case(c), "written"), c));
  }
  const Case given =
      parse_case(small_case + "[formulation]\nartificial_stress = 0.2\nmotion = 'proposed'\n", "box.toml");
  CHECK(given.formulation.artificial_stress == 0.2);
  CHECK(given.formulation.artificial_viscosity_alpha == 0.1);
}

TEST_CASE("the foundation is the paper's") {
  const Case c = read_case(std::string(POROSPH_SOURCE_DIR) + "/cases/foundation.toml");
  CHECK(c.soils[0].polygon == Polygon{{0, 0}, {15, 0}, {15, 10}, {0, 10}});
  CHECK(c.smoothing_length() == Approx(0.24));
  CHECK(c.soils[0].youngs_modulus == 15e6);
  CHECK(c.soils[0].poissons_ratio == 0.33);
  CHECK(c.soils[0].unit_weight_saturated == 20e3);
  CHECK(c.water.unit_weight == 9810);
  CHECK(c.water.stretches.at(0).level == 15);
  CHECK(c.boundaries.size() == 3);
  CHECK(c.boundaries[1].to == Point(15, 15));
  CHECK(c.loading.damping == 0.002);
  CHECK(c.time.end == 4);
  CHECK(c.time.courant == 0.2);
  CHECK(c.output.interval == 0.1);
  CHECK(c.formulation.motion == Motion::consistent);
  CHECK(c.reference == Reference::column);
  CHECK(c.probes.at(1).position == Point(7.5, 0.1));
}

TEST_CASE("the embankment's lattice has the paper's 8454 particles") {
  const Case c = read_case(std::string(POROSPH_SOURCE_DIR) + "/cases/embankment.toml");
  CHECK(c.soils[0].unit_weight_unsaturated == 18.6e3);
  CHECK(c.soils[0].poissons_ratio == 0.25);
  CHECK(c.water.stretches.at(0).level == 8);
  CHECK(c.probes.at(0).position == Point(17.7, 3));

  // The upper outline, cell centres inside or on it.
  const auto top = [](double x) {
    if (x < 10 || x > 33) return 6.;
    if (x < 15) return 6 + (x - 10);
    return x > 20.5 ? 6 + (33 - x) / 2.5 : 11.;
  };
  int particles = 0;
  for (double x = 0.1; x < 44.4; x += 0.2)
    for (double y = 0.1; y < top(x) + 1e-9; y += 0.2) ++particles;
  CHECK(particles == 8454);
  CHECK(c.soils[0].polygon ==
        Polygon{{0, 0}, {44.4, 0}, {44.4, 6}, {33, 6}, {20.5, 11}, {15, 11}, {10, 6}, {0, 6}});
}

TEST_CASE("the fields that a case may ask for are those that frames can hold") {
  Simulation simulation(box_of_soil(4, 4));
  for (const Field& field : field_table()) {
    INFO(field.name);
    if (field.name == particle_fields::excess_stress.name) continue;  // of cases with an exact solution
    CHECK(make_frame(simulation, {std::string(field.name)}).fields.size() == 1);
  }
}

// After a change of keys: unit_solver "[.write-docs]" rewrites the reference part.
TEST_CASE("the case format's documentation is up to date") {
  CHECK(contents("docs/case-format.md").ends_with("\n## Reference\n\n" + describe_case_format()));
}
TEST_CASE("write the case format's documentation", "[.write-docs]") {
  const std::string old_text = contents("docs/case-format.md"), head = "\n## Reference\n\n";
  const auto introduction = old_text.substr(0, old_text.find(head));
  std::ofstream(std::string(POROSPH_SOURCE_DIR) + "/docs/case-format.md")
      << introduction << head << describe_case_format();
  SUCCEED();
}

TEST_CASE("damaged files are read or refused, never worse") {
  const std::string sound = contents("cases/foundation.toml");
  std::mt19937 random(20240501);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const std::string structure = "[]{}\"'=.,#\n-0e9x";
  int read = 0, refused = 0;
  for (int i = 0; i < 800; ++i) {
    std::string text = sound;
    for (std::size_t n = 1 + below(4); n > 0; --n) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text[at] = structure[below(structure.size())];
          break;
        case 2:
          text.erase(at, 1 + below(20));
          break;
        default:
          text.insert(at, text.substr(below(text.size()), 1 + below(30)));
      }
    }
    try {
      const Case c = parse_case(text, "damaged");
      INFO(text);
      CHECK(same(parse_case(write_case(c), "written"), c));
      ++read;
    } catch (const CaseError& error) {
      CHECK(std::string(error.what()).size() > 0);
      ++refused;
    }
  }
  CHECK(read > 0);
  CHECK(refused > 400);
}
