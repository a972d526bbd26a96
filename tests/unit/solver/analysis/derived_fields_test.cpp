// Fields computed from stored frames, against what is known of simple states and what a run itself writes.
#include "solver/analysis/derived_fields.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/analysis/frame_values.hpp"
#include "solver/fields/field_table.hpp"
#include "solver/output/fields.hpp"
#include "solver/run/run.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

/// One particle under an effective stress and a pore pressure.
Frame stressed(const Stress& s, double pressure) {
  Frame frame;
  frame.points = {1, 2, 0};
  frame.fields = {{"EffectiveStress", component_names(FieldKind::symmetric),
                   std::vector<double>{s.xx, s.yy, s.zz, s.xy, 0, 0}},
                  {"PorePressure", {}, std::vector<double>{pressure}}};
  return frame;
}

double value(const Frame& frame, const std::string& field) {
  return values_of(frame, parse_selection(field)).front();
}

/// A square of particles that was deformed by F.
Frame deformed(const Mat2& f, double spacing) {
  Frame frame;
  std::vector<double> displacement;
  const int side = 12;
  for (int i = 0; i < side * side; ++i) {
    const Vec2 start(spacing * (i % side + 0.5), spacing * (i / side + 0.5)), position = f * start,
                                                                              u = position - start;
    frame.points.insert(frame.points.end(), {position.x(), position.y(), 0});
    displacement.insert(displacement.end(), {u.x(), u.y(), 0});
  }
  const std::vector<double> ones(side * side, 1.0);
  frame.fields = {{"Displacement", component_names(FieldKind::vector), displacement},
                  {"SmoothingLength", {}, std::vector<double>(ones.size(), 1.2 * spacing)},
                  {"Mass", {}, std::vector<double>(ones.size(), spacing * spacing)},
                  {"Density", {}, ones}};
  return frame;
}

}  // namespace

TEST_CASE("invariants are computed from a stored stress", "[output]") {
  const Frame frame = stressed({-3e3, -9e3, -4e3, 4e3}, -5e3);  // in the plane: mean -6, radius 5
  CHECK(value(frame, "PrincipalStress:S1") == Approx(-1e3));
  CHECK(value(frame, "PrincipalStress:S2") == Approx(-4e3));
  CHECK(value(frame, "PrincipalStress:S3") == Approx(-11e3));
  CHECK(value(frame, "MeanPressure") == Approx(16e3 / 3));
  CHECK(value(frame, "MeanStress") == Approx(-16e3 / 3));
  CHECK(value(frame, "MaximumShearStress") == Approx(5e3));
  const double q = std::sqrt(0.5 * (9e6 + 49e6 + 100e6));
  CHECK(value(frame, "VonMisesStress") == Approx(q));
  CHECK(value(frame, "StressRatio") == Approx(q * 3 / 16e3));
  CHECK(value(frame, "StressObliquity") == Approx(std::asin(10. / 12) * 180 / M_PI));
  CHECK(value(frame, "TotalStress:YY") == Approx(-14e3));
  CHECK(value(frame, "TotalStress:XY") == Approx(4e3));
  CHECK(value(frame, "DeviatoricStress:YY") == Approx(-9e3 + 16e3 / 3));
  CHECK(value(frame, "PorePressureRatio") == Approx(5. / 14));
}

TEST_CASE("soil at K0 has an obliquity of asin((1 - K0) / (1 + K0))", "[output]") {
  for (const double k0 : {0.3, 0.5, 0.8}) {
    const Frame frame = stressed({-k0 * 50e3, -50e3, -k0 * 50e3, 0}, 0);
    CHECK(std::sin(value(frame, "StressObliquity") * M_PI / 180) == Approx((1 - k0) / (1 + k0)));
  }
}

TEST_CASE("what has no meaning in tension is not a number", "[output]") {
  const Frame frame = stressed({2e3, -1e3, 0, 0}, 0), dry = stressed({0, 3e3, 0, 0}, 0);
  CHECK(std::isnan(value(frame, "StressObliquity")));
  CHECK(std::isnan(value(frame, "StressRatio")));
  CHECK(value(dry, "PorePressureRatio") == 0);
  CHECK(value(frame, "MaximumShearStress") == Approx(1.5e3));
}

TEST_CASE("strains are computed from stored displacements, exact where they are linear", "[output]") {
  for (const double spacing : {0.1, 0.7})
    for (const Mat2& f : {Mat2{{1.02, 0.05}, {-0.03, 0.97}}, Mat2{{1, 0.4}, {0, 1}}, Mat2{{0, -1}, {1, 0}}}) {
      const Frame frame = deformed(f, spacing);
      const Mat2 e = 0.5 * (f.transpose() * f - Mat2::Identity());
      const double difference = std::hypot(e(0, 0) - e(1, 1), 2 * e(0, 1));
      for (const double v : values_of(frame, {"VolumetricStrain", ""}))
        CHECK(v == Approx(f.determinant() - 1).margin(1e-12));
      for (const double v : values_of(frame, {"ShearStrain", ""}))
        CHECK(v == Approx(difference).margin(1e-12));
      for (const double v : values_of(frame, {"Strain", "XY"})) CHECK(v == Approx(e(0, 1)).margin(1e-12));
    }
}

TEST_CASE("the head is the height to which water would rise", "[output]") {
  Frame frame = stressed({}, -3 * 9810.);
  add_water_unit_weight(frame, 9810);
  CHECK(value(frame, "Head") == Approx(2 + 3));
  Frame above = stressed({}, 0);
  add_water_unit_weight(above, 9810);
  CHECK(std::isnan(value(above, "Head")));
}

TEST_CASE("computed fields are those that the run would have written", "[output]") {
  Case scene = box_of_soil(4, 8);
  hold_as_column(scene);
  add_water(scene, 5);
  Simulation simulation(scene);
  for (int i = 0; i < 40; ++i) simulation.advance();
  const std::vector<std::string> written = {"TotalStress",      "PrincipalStress", "MeanStress",
                                            "DeviatoricStress", "VonMisesStress",  "Strain"};
  const Frame stored = make_frame(simulation, written);
  const Frame frame = make_frame(simulation, standard_field_names());
  Frame bare = frame;
  std::erase_if(bare.fields, [](const FrameField& f) { return f.name == "TotalStress"; });
  for (const FrameField& field : stored.fields) {
    CAPTURE(field.name);
    const auto& expected = std::get<std::vector<double>>(field.values);
    const FrameField computed = derived_field(bare, field.name).value();
    CHECK(computed.components == field.components);
    const auto& got = std::get<std::vector<double>>(computed.values);
    REQUIRE(got.size() == expected.size());
    double difference = 0, largest = 0;
    for (std::size_t i = 0; i < got.size(); ++i) {
      difference = std::max(difference, std::abs(got[i] - expected[i]));
      largest = std::max(largest, std::abs(expected[i]));
    }
    CHECK(largest > 0);
    CHECK(difference <= 1e-12 * (field.name == "Strain" ? 1 : largest));
  }
}

TEST_CASE("the error about an unknown field lists the known ones", "[output]") {
  const Frame frame = stressed({}, 0);
  CHECK_THROWS_WITH(values_of(frame, {"VonMisesStres", ""}),
                    Contains("did you mean 'VonMisesStress'?") &&
                        Contains("it has EffectiveStress, PorePressure") &&
                        Contains("from these are computed TotalStress, PrincipalStress"));
  CHECK_THROWS_WITH(values_of(frame, {"ShearStrain", ""}),
                    Contains("no field 'ShearStrain', and not Displacement, SmoothingLength"));
  CHECK_THROWS_WITH(values_of(frame, {"PrincipalStress", ""}), Contains("PrincipalStress:S1"));
  CHECK(can_show(frame, "StressRatio"));
  CHECK_FALSE(can_show(frame, "Strain"));
}
