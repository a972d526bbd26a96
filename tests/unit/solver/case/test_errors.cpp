#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "solver/printable.hpp"
#include "tests/unit/solver/case/case_text.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("values that are wrong by themselves") {
  struct Wrong {
    std::string old_text, new_text, error;
  };
  const Wrong wrong = GENERATE(values<Wrong>({
      {"youngs_modulus = 1e6", "youngs_modulus = -3",
       "box.toml:9:18: key 'soil[0].youngs_modulus' = -3: must be > 0 and <= 1e+15 Pa"},
      {"poissons_ratio = 0.3", "poissons_ratio = 0.5",
       "box.toml:10:18: key 'soil[0].poissons_ratio' = 0.5: must be > -1 and < 0.5"},
      {"end = 1", "end = nan", "box.toml:19:7: key 'time.end' = nan: must be finite"},
      {"end = 1", "end = inf", "box.toml:19:7: key 'time.end' = inf: must be finite"},
      {"end = 1", "end = '1'",
       "box.toml:19:7: key 'time.end' = \"1\": must be a number in s"
       ", or text of a number and a unit; allowed are s, ms, min, h, d, yr"},
      {"end = 1", "end = true",
       "box.toml:19:7: key 'time.end' = true: must be a number in s"
       ", or text of a number and a unit; allowed are s, ms, min, h, d, yr"},
      {"end = 1", "", "box.toml:18:1: key 'time.end': is missing: When the run ends."},
      {"[time]\nend = 1\n", "", "box.toml:1:1: key 'time.end': is missing: When the run ends."},
      {"end = 1", "end = 1\ncorant = 1",
       "box.toml:20:1: key 'time.corant': is not known; did you mean 'courant'?"},
      {"end = 1", "end = 1\nfoo = 1",
       "box.toml:20:1: key 'time.foo': is not known; known are end, courant, step"},
      {"[[soil]]", "[soil]",
       "box.toml:6:1: key 'soil': must be a list of tables [[soil]], at most 1000, at least one"},
      {"[particles]\nspacing = 0.5", "particles = 3",
       "box.toml:3:13: key 'particles' = 3: must be a table: [particles]"},
      {"title = \"Box\"", "title = 3", "box.toml:1:9: key 'title' = 3: must be text"},
      {"\"sand\"", "\"fine sand\"",
       "box.toml:7:8: key 'soil[0].name' = \"fine sand\": must be 1 to 40 letters (a-z, A-Z), digits, '_' or "
       "'-'"},
      {"\"fixed\"", "\"fixd\"",
       "box.toml:14:8: key 'boundary[0].kind' = \"fixd\": must be one of \"roller\", \"fixed\", "
       "\"friction\", \"periodic\"; did you mean 'fixed'?"},
      {"from = [0, 0]", "from = [0, 0, 0]",
       "box.toml:15:8: key 'boundary[0].from': must be two numbers [x, y] in m"},
      {"[4, 2]", "[4, 2e8]",
       "box.toml:8:32: key 'soil[0].polygon[2][1]' = 200000000: must be >= -1e+08 and <= 1e+08 m"},
      {"[4, 2]", "[4, '2']",
       "box.toml:8:32: key 'soil[0].polygon[2][1]' = \"2\": must be a number in m"
       ", or text of a number and a unit; allowed are m, km, cm, mm, ft, in"},
      {"[4, 0], [4, 2], [0, 2]]", "[4, 0]]",
       "box.toml:8:11: key 'soil[0].polygon': must be a list of 3 to 10000 points [x, y]"},
      {"spacing = 0.5", "spacing = 0.5\nsmoothing_ratio = 4",
       "box.toml:5:19: key 'particles.smoothing_ratio' = 4: must be >= 0.8 and <= 3"},
      {"spacing = 0.5", "spacing = 0.5\narrangement = 'disordered'\nseed = 1.5",
       "box.toml:6:8: key 'particles.seed' = 1.5: must be a whole number >= 0 and <= 999999"},
      {"poissons_ratio", "no_tension = 1\npoissons_ratio",
       "box.toml:10:14: key 'soil[0].no_tension' = 1: must be true or false"},
      {"poissons_ratio", "law = 'mohr-coulomb'\npoissons_ratio",
       "box.toml:10:7: key 'soil[0].law' = \"mohr-coulomb\": must be one of \"elastic\", \"drucker_prager\", "
       "\"mohr_coulomb\", \"tresca\", \"modified_cam_clay\", \"byrne\"; did you mean 'mohr_coulomb'?"},
      {"poissons_ratio", "cohesion = 1e3\npoissons_ratio",
       "box.toml:10:12: key 'soil[0].cohesion' = 1000: is used only with law = \"drucker_prager\", "
       "\"mohr_coulomb\" or \"byrne\""},
      {"poissons_ratio", "law = 'tresca'\nundrained_strength = 0\npoissons_ratio",
       "box.toml:11:22: key 'soil[0].undrained_strength' = 0: must be > 0 and <= 1e+15 Pa"},
      {"poissons_ratio",
       "law = 'mohr_coulomb'\ncohesion = 0\nfriction_angle = 30\ndilation_angle = 31\npoissons_ratio",
       "box.toml:13:18: key 'soil[0].dilation_angle' = 31: must be <= friction_angle = 30 degrees"},
      {"poissons_ratio",
       "law = 'mohr_coulomb'\ncohesion = 0\nfriction_angle = 30\ndilation_limit = 0.05\npoissons_ratio",
       "box.toml:13:18: key 'soil[0].dilation_limit' = 0.05: is used only with law = \"drucker_prager\", "
       "\"mohr_coulomb\" or \"byrne\" and dilation_angle > 0"},
      {"poissons_ratio",
       "law = 'drucker_prager'\ncohesion = 1\nfriction_angle = 30\nresidual_cohesion = 0.5\npoissons_ratio",
       "box.toml:13:21: key 'soil[0].residual_cohesion' = 0.5: is used only with softening = \"exponential\" "
       "or "
       "\"linear\""},
      {"poissons_ratio",
       "law = 'drucker_prager'\nno_tension = true\ncohesion = 1\nfriction_angle = 30\npoissons_ratio",
       "box.toml:11:14: key 'soil[0].no_tension' = true: is used only with law = \"elastic\""},
      {"end = 1", "end = 1\n[output]\nfields = ['Velocty']",
       "box.toml:21:11: key 'output.fields[0]' = \"Velocty\": must be one of Displacement, Velocity, "
       "EffectiveStress, "
       "TotalStress, PorePressure, Density, Mass, SmoothingLength, SoilId, ParticleId, "
       "PrincipalStress, MeanStress, DeviatoricStress, VonMisesStress, Strain, ExcessStress, Yielding, "
       "MobilisedFriction, Head, PressureHead, Saturation, DarcyVelocity, HydraulicGradient, "
       "GradientRatio, PorePressureRatio, PlasticStrain, Opening, Dilation, UndrainedStrength, VoidRatio, "
       "Preconsolidation, Compaction, CyclicStrain, TurningStrain, FarthestStrain; "
       "did you mean "
       "'Velocity'?"},
      {"end = 1", "end = 1\n[output]\nfields = ['Mass', 'Mass']",
       "box.toml:21:19: key 'output.fields[1]' = \"Mass\": is given twice"},
      {"end = 1", "end = 1\n[output]\ninterval = 1e-9",
       "box.toml:21:12: key 'output.interval' = 1e-09: makes 1e+09 frames; at most 1e+05"},
      {"end = 1", "end = 1\n[output]\ntimes = [0.5, 2]",
       "box.toml:21:15: key 'output.times[1]' = 2: must be <= time.end = 1 s"},
      {"end = 1", "end = 1\n[output]\ntimes = [-1]",
       "box.toml:21:10: key 'output.times[0]' = -1: must be >= 0 and <= 1e+09 s"},
      {"end = 1", "end = 1\n[output]\nformat = 'vtx'",
       "box.toml:21:10: key 'output.format' = \"vtx\": must be one of \"vtp\", \"vtu\"; did you mean 'vtp'?"},
      {"end = 1", "end = 1\n[output]\nfields = ['ExcessStress']",
       "box.toml:21:11: key 'output.fields[0]' = \"ExcessStress\": is the excess over the exact solution: "
       "needs 'reference'"},
  }));
  CHECK(errors_of(with(wrong.old_text, wrong.new_text)) == wrong.error);
}

TEST_CASE("settings that would not be used") {
  const auto motion = GENERATE(as<std::string>{}, "conventional", "proposed", "rho_squared");
  for (const std::string key : {"bulk_viscosity", "zero_energy_control", "refresh_strain"})
    CHECK(errors_with("[formulation]\nmotion = '" + motion + "'\n" + key + " = 0.01\n") ==
          "box.toml:22:" + std::to_string(key.size() + 4) + ": key 'formulation." + key +
              "' = 0.01: is used only with motion = \"consistent\"");
  CHECK(errors_of(with("spacing = 0.5", "spacing = 0.5\ndisorder = 0.1")) ==
        "box.toml:5:12: key 'particles.disorder' = 0.1: is used only with arrangement = \"disordered\"");
  CHECK(errors_with("[loading]\nk0 = 0.5\n") ==
        "box.toml:21:6: key 'loading.k0' = 0.5: is used only with k0_stress = true");
  CHECK(errors_with("[loading]\ndamping_until = 1\n") ==
        "box.toml:21:17: key 'loading.damping_until' = 1: is used only with damping > 0");
  CHECK(errors_with("[loading]\ngravity_applied = false\nk0_stress = true\n") ==
        "box.toml:22:13: key 'loading.k0_stress' = true: is used only with gravity_applied = true");
}

TEST_CASE("a wrong key is not blamed on those that depend on it") {
  CHECK(errors_with("[loading]\nk0_stress = 1\nk0 = 0.5\n") ==
        "box.toml:21:13: key 'loading.k0_stress' = 1: must be true or false");
  CHECK(errors_of(with("20e3", "-20e3\nunit_weight_unsaturated = 18e3")) ==
        "box.toml:11:25: key 'soil[0].unit_weight_saturated' = -20000: must be > 0 and <= 1e+09 N/m3");
}

TEST_CASE("water") {
  CHECK(errors_with("[water]\n") ==
        "box.toml:20:1: key 'water': needs one of 'level', 'stretches' and 'level_over_time'");
  CHECK(errors_with("[water]\nlevel = 1\nstretches = [{level = 1}]\n") ==
        "box.toml:20:1: key 'water': needs one of 'level', 'stretches' and 'level_over_time'");
  CHECK(errors_with("[water]\nstretches = [{x_from = 3, x_to = 2, level = 1}]\n") ==
        "box.toml:21:34: key 'water.stretches[0].x_to' = 2: must be > x_from = 3 m");
  CHECK(errors_with("[water]\nstretches = [{x_to = 2, level = 1}, {x_from = 1, level = 1}]\n") ==
        "box.toml:21:37: key 'water.stretches[1]': overlaps water.stretches[0]");
  const Case c =
      parse_case(small_case + "[water]\nstretches = [{x_to = 2, level = 1}, {x_from = 2, level = 3}]\n", "");
  CHECK(c.water.stretches.at(1).x_from == 2);
  CHECK(c.water.stretches.at(1).x_to == never);
}

TEST_CASE("all errors are reported at once, in the order of the file") {
  std::string text = with("youngs_modulus = 1e6", "youngs_modulus = 0");
  text.replace(text.find("end = 1"), 7, "ende = 1");
  text += "[[probe]]\nname = \"A\"\nposition = [9, 1]\n[[probe]]\nname = \"A\"\nposition = [1, 1]\n";
  CHECK(errors_of(text) ==
        "box.toml:9:18: key 'soil[0].youngs_modulus' = 0: must be > 0 and <= 1e+15 Pa\n"
        "box.toml:18:1: key 'time.end': is missing: When the run ends.\n"
        "box.toml:19:1: key 'time.ende': is not known; did you mean 'end'?\n"
        "box.toml:22:12: key 'probe[0].position': (9, 1) is outside all soils\n"
        "box.toml:24:8: key 'probe[1].name' = \"A\": is the name of probe[0] too");
}

TEST_CASE("text that is no TOML") {
  CHECK_THAT(errors_of(with("end = 1", "end = 1 2")), StartsWith("box.toml:19:9: "));
  CHECK_THAT(errors_of(with("end = 1", "end = 1\nend = 2")), StartsWith("box.toml:20:"));
  CHECK_THAT(errors_of(with("Box", "B\xff")), StartsWith("box.toml:1:"));
  CHECK_THAT(errors_of(std::string("a = '\0'", 7)), StartsWith("box.toml:1:"));
  CHECK_THAT(errors_of(std::string(5000, '[')), StartsWith("box.toml:1:"));
  CHECK_THAT(errors_of(""), Contains("key 'soil': is missing"));
  CHECK(errors_of(std::string((16 << 20) + 1, ' ')) ==
        "box.toml: has 16777217 bytes; at most 16777216 are read");
}

TEST_CASE("keys nested so deeply that reading them would use up the stack") {
  const auto nested = [](const std::string& name, std::size_t times) {
    std::string key = name;
    for (std::size_t i = 0; i < times; ++i) key += "." + name;
    return key;
  };
  for (const char* name : {"a", "'a b'", "1", "1-1", "\"[\"", "a "}) {
    const std::string error = "box.toml:20:1: more than 100 dots in a line: keys are not nested so deeply";
    CHECK(errors_with(nested(name, 1000000) + " = 1\n") == error);
    CHECK(errors_with("[" + nested(name, 200) + "]\n") == error);
    CHECK(errors_with("x = {" + nested(name, 200) + " = 1}\n") == error);
  }
  CHECK_THAT(errors_with("a = 1", {nested("a", 100000) + "=1"}), Contains("nested deeper than any"));
  CHECK(errors_with(
            "# ............................................................................................."
            "....................\n")
            .empty());
  std::string numbers = "[[0, 0], [4, 0], [4, 2]";
  for (int i = 0; i < 500; ++i) numbers += fmt::format(", [{}, 1.5e0]", 4 - i / 200.0 - 0.01);
  CHECK_THAT(errors_of(with("[[0, 0], [4, 0], [4, 2]", numbers)), !Contains("dots"));
}

TEST_CASE("text that a terminal obeys is refused, and told without it") {
  const auto title = [](const std::string& text) { return errors_of(with("\"Box\"", "\"" + text + "\"")); };
  CHECK(title("Böschung, σ'yy").empty());
  for (const auto& [text, name] : {std::pair{"\\u001b[2J", "U+001B"},
                                   {"a\\nb", "U+000A"},
                                   {"\\t", "U+0009"},
                                   {"\\u009b31m", "U+009B"},
                                   {"\\u202e", "U+202E"},
                                   {"\\u007f", "U+007F"}}) {
    CAPTURE(text);
    const std::string errors = title(text);
    CHECK_THAT(errors, StartsWith("box.toml:1:9: key 'title' = ") &&
                           Contains(std::string("must not hold control characters, but has ") + name));
    CHECK(control_character(errors).empty());
  }
  const std::string of_key = errors_with("\"\\u001b[31mend\" = 2\n");
  CHECK_THAT(of_key, Contains("key 'time.[U+001B][31mend': is not known"));
  CHECK(control_character(of_key).empty());
}

TEST_CASE("a file with very many errors tells the first") {
  std::string many;
  for (int i = 0; i < 300; ++i) many += fmt::format("x{} = 1\n", i);
  const std::string errors = errors_with(many);
  CHECK(std::count(errors.begin(), errors.end(), '\n') == 100);
  CHECK_THAT(errors, Contains("box.toml:20:1: key 'time.x0': is not known") &&
                         Contains("\nbox.toml: and 200 more errors"));
}

TEST_CASE("files that cannot be read") {
  CHECK_THROWS_WITH(read_case("no/such/case.toml"),
                    "no/such/case.toml: is not a readable file: No such file or directory");
  const auto folder = std::filesystem::temp_directory_path();
  CHECK_THROWS_WITH(read_case(folder), folder.string() + ": is not a readable file");
  const auto file = folder / "porosph_too_large.toml";
  std::ofstream(file) << "#";
  std::filesystem::resize_file(file, (16 << 20) + 1);
  CHECK_THROWS_WITH(read_case(file), file.string() + ": has 16777217 bytes; at most 16777216 are read");
  std::filesystem::remove(file);
}
