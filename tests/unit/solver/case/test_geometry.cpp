#include "tests/unit/solver/case/case_text.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

namespace {

const std::string sand_outline = "[[0, 0], [4, 0], [4, 2], [0, 2]]";

std::string errors_of_outline(const std::string& outline) { return errors_of(with(sand_outline, outline)); }

std::string soil(const std::string& name, const std::string& outline) {
  return "[[soil]]\nname = '" + name + "'\npolygon = " + outline +
         "\nyoungs_modulus = 1e6\npoissons_ratio = 0.3\nunit_weight_saturated = 2e4\n";
}
std::string boundary(const std::string& from, const std::string& to, const std::string& kind = "roller") {
  return "[[boundary]]\nkind = '" + kind + "'\nfrom = " + from + "\nto = " + to + "\n";
}

}  // namespace

TEST_CASE("outlines") {
  const std::string at = "box.toml:8:11: key 'soil[0].polygon': ";
  CHECK(errors_of_outline("[[0, 0], [4, 2], [4, 0], [0, 2]]") == at + "crosses or touches itself at (2, 1)");
  CHECK(errors_of_outline("[[0, 0], [4, 0], [4, 2], [1, -1], [0, 2]]") ==
        at + "crosses or touches itself at (2, 0)");
  CHECK(errors_of_outline("[[0, 0], [4, 0], [4, 2], [2, 0], [0, 2]]") ==
        at + "crosses or touches itself at (2, 0)");
  CHECK(errors_of_outline("[[0, 0], [4, 0], [4, 2], [4, 1], [0, 1]]") ==
        at + "crosses or touches itself at (4, 2)");
  CHECK(errors_of_outline("[[0, 0], [4, 0], [8, 0]]") == at + "has no area: its points lie in one line");
  CHECK(errors_of_outline("[[0, 0], [4, 0], [4, 0], [4, 2]]") == at + "points 1 and 2 (from 0) are the same");
  CHECK(errors_of_outline("[[0, 0], [4, 0], [4, 2], [0, 0]]") ==
        at + "its last point repeats the first: leave it out");
  CHECK(errors_of_outline("[[0, 0], [4, 0], [4, 0.4], [0, 0.4]]") ==
        at + "soil 'sand' is 0.4 m thick, less than particles.spacing = 0.5 m");
  CHECK(errors_of_outline("[[0, 2], [4, 2], [4, 0], [0, 0]]").empty());
  CHECK(errors_of_outline("[[0, 0], [4, 0], [4, 0.5], [0, 0.5]]").empty());
}

TEST_CASE("holes") {
  const auto errors = [](const std::string& holes) {
    return errors_of(with(sand_outline, sand_outline + "\nholes = " + holes));
  };
  const std::string at = "box.toml:9:9: key 'soil[0].holes': ";
  CHECK(errors("[[[1, 0.5], [2, 0.5], [2, 1]]]").empty());
  CHECK(errors("[[[1, 0.5], [5, 0.5], [2, 1]]]") == at + "hole 0 (from 0) is not inside the polygon");
  CHECK(errors("[[[1, 0], [2, 0], [2, 1]]]") == at + "a hole touches the polygon");
  CHECK(errors("[[[1, 0.5], [2, 0.5], [2, 1]], [[1.5, 0.2], [3, 0.2], [1.8, 1.5]]]") ==
        at + "holes 0 and 1 (from 0) touch or overlap");
  CHECK(errors("[[[1, 0.5], [2, 1], [2, 0.5], [1, 1]]]") ==
        "box.toml:9:10: key 'soil[0].holes[0]': crosses or touches itself at (1.5, 0.75)");
}

TEST_CASE("soils may touch, not overlap") {
  CHECK(errors_with(soil("clay", "[[4, 0], [6, 0], [6, 2], [4, 2]]")).empty());
  CHECK(errors_with(soil("clay", "[[3, 0], [6, 0], [6, 2], [3, 2]]")) ==
        "box.toml:22:11: key 'soil[1].polygon': soils 'sand' and 'clay' overlap by 2 m2, between (3, 0) and "
        "(4, 2)");
  CHECK(errors_with(soil("clay", "[[1, 0.2], [3, 0.2], [3, 1], [1, 1]]")) ==
        "box.toml:22:11: key 'soil[1].polygon': soils 'sand' and 'clay' overlap by 1.6 m2, between (1, 0.2) "
        "and (3, 1)");
  const std::string hole = "[[1, 0.2], [3, 0.2], [3, 1], [1, 1]]";
  CHECK(
      errors_of(with(sand_outline, sand_outline + "\nholes = [" + hole + "]") + soil("clay", hole)).empty());
  CHECK_THAT(errors_with(soil("sand", "[[4, 0], [6, 0], [6, 2], [4, 2]]")),
             Contains("box.toml:21:8: key 'soil[1].name' = \"sand\": is the name of soil[0] too"));
}

TEST_CASE("places in messages have digits enough for coordinates of maps") {
  const std::string far = "[[4512344.25, 0], [4512348.25, 0], [4512348.25, 2], [4512344.25, 2]]";
  std::string text = with(sand_outline, far);
  text.replace(text.find("from = [0, 0]"), 13, "from = [4512344.25, 0]");
  text.replace(text.find("to = [4, 0]"), 11, "to = [4512348.25, 0]");
  CHECK(errors_of(text).empty());
  CHECK_THAT(errors_of(text + soil("clay", "[[4512347.25, 0], [4512350, 0], [4512350, 2], [4512347.25, 2]]")),
             Contains("overlap by 2 m2, between (4512347.25, 0) and (4512348.25, 2)"));
  CHECK_THAT(errors_of(text + soil("clay", "[[4512348.5, 0], [4512350, 0], [4512350, 2], [4512348.5, 2]]")),
             Contains("0.25 m apart at (4512348."));
  CHECK_THAT(errors_of(text + boundary("[4512345.25, 0]", "[4512345.25, 2]")),
             Contains("has soil on both sides at (4512345.25, 1)"));
}

TEST_CASE("water touches soil: over it or at an upright face below its level") {
  const auto errors = [](const std::string& stretch) {
    return errors_with("[[water.stretches]]\n" + stretch + "\nlevel = 1\n");
  };
  const std::string at = "box.toml:20:1: key 'water.stretches[0]': touches no soil: ";
  CHECK(errors("x_to = 0").empty());
  CHECK(errors("x_from = 4").empty());
  CHECK(errors("x_from = 1\nx_to = 2").empty());
  CHECK(errors("x_to = 0.05").empty());
  CHECK(errors("x_to = -1") == at + "it ends 1 m beside soil 'sand', the nearest");
  CHECK(errors("x_from = 4.01") == at + "it ends 0.01 m beside soil 'sand', the nearest");
  CHECK(errors_of(with(sand_outline, "[[0, 0], [4, 0], [4, 2], [1, 2]]") +
                  "[[water.stretches]]\nx_to = 0\nlevel = 1\n") ==
        at + "where it ends soil 'sand' has no upright face below its level");
  CHECK(errors_with("[[water.stretches]]\nx_to = 0\nlevel = -1\n") ==
        at + "where it ends soil 'sand' has no upright face below its level");
}

TEST_CASE("the number of particles is bounded before memory is taken") {
  CHECK(errors_of(with("spacing = 0.5", "spacing = 1e-4")) ==
        "box.toml:4:11: key 'particles.spacing' = 0.0001: makes 8e+08 particles, which need about 576 GB of "
        "memory; at "
        "most 5e+07");
  CHECK_THAT(errors_of(with("spacing = 0.5", "spacing = 1e-200")), Contains("makes inf particles"));
  CHECK(errors_of(with("spacing = 0.5", "spacing = 4.1e-4")).empty());
}

TEST_CASE("boundaries lie on an outline, with soil on one side") {
  const std::string at = "box.toml:20:1: key 'boundary[1]': ";
  CHECK(errors_with(boundary("[0, 0]", "[0, 9]")).empty());
  CHECK(errors_with(boundary("[0, 9]", "[0, -1]")).empty());
  CHECK(errors_with(boundary("[0, 2]", "[0, 9]")) == at + "does not lie on the outline of any soil");
  CHECK(errors_with(boundary("[9, 0]", "[9, 2]")) == at + "does not lie on the outline of any soil");
  CHECK(errors_with(boundary("[0, 0]", "[0, 0]")) == at + "is shorter than the spacing of 0.5 m");
  CHECK(errors_with(boundary("[1, 0]", "[1, 2]")) == at + "has soil on both sides at (1, 1) (soil 'sand')");
  CHECK(errors_with(soil("clay", "[[4, 0], [6, 0], [6, 2], [4, 2]]") + boundary("[4, 0]", "[4, 2]")) ==
        "box.toml:26:1: key 'boundary[1]': has soil on both sides at (4, 1) (soil 'clay')");
  CHECK(errors_with(soil("clay", "[[2, 2], [4, 2], [4, 4], [2, 4]]") + boundary("[0, 2]", "[4, 2]")) ==
        "box.toml:26:1: key 'boundary[1]': has soil on both sides at (3, 2) (soil 'clay')");
  CHECK(errors_with(soil("clay", "[[5, -2], [7, -2], [7, 0], [5, 0]]") +
                    boundary("[5, 0]", "[5, -2]", "fixed") + boundary("[4, 2]", "[4, -2]"))
            .empty());
}

TEST_CASE("a boundary that changes sides") {
  const std::string text = with("to = [4, 0]", "to = [8, 0]");
  CHECK(errors_of(text + soil("clay", "[[5, -2], [7, -2], [7, 0], [5, 0]]")) ==
        "box.toml:13:1: key 'boundary[0]': has soil on its left and, further along, on its right: split it");
}

TEST_CASE("boundaries meet at any angle that leaves the soil 30 degrees") {
  const std::string sharp = "[[0, 0], [4, 0], [4, 2]]", slope = "[[0, 0], [4, 0], [4, 2], [1, 2]]";
  CHECK(errors_of(with(sand_outline, sharp) + boundary("[0, 0]", "[4, 2]")) ==
        "box.toml:20:1: key 'boundary[1]': meets boundary[0] at an angle of 26.57 degrees: the soil between "
        "them "
        "must have 30 degrees or more");
  // The same lines with the soil beyond them: 153 and 333 degrees.
  const std::string flat = "[[0, 0], [4, 0], [4, 2], [-4, 2]]";
  CHECK(errors_of(with(sand_outline, flat) + boundary("[0, 0]", "[-4, 2]")).empty());
  const std::string spike = "[[0, 0], [4, 0], [4, 2], [-2, 2], [-2, -2], [4, -2]]";
  CHECK(errors_of(with(sand_outline, spike) + boundary("[0, 0]", "[4, -2]")).empty());
  CHECK(errors_of(with(sand_outline, slope) + boundary("[0, 0]", "[1, 2]")).empty());
  CHECK(errors_of(with(sand_outline, slope) + boundary("[0.5, 1]", "[1, 2]")).empty());
  CHECK(errors_of(with("to = [4, 0]", "to = [2, 0]") + boundary("[2, 0]", "[4, 0]")).empty());
  CHECK(errors_with(boundary("[3, 0]", "[6, 0]")) ==
        "box.toml:20:1: key 'boundary[1]': meets boundary[0] along 1 m: must be one or the other");
  // A box turned by 3:4:5, whose walls meet at a right angle but for rounding.
  std::string turned = with(sand_outline, "[[0, 0], [0.4, 0.3], [-0.2, 1.1], [-0.6, 0.8]]");
  turned.replace(turned.find("to = [4, 0]"), 11, "to = [0.4, 0.3]");
  turned.replace(turned.find("spacing = 0.5"), 13, "spacing = 0.1");
  CHECK(
      errors_of(turned + boundary("[0, 0]", "[-0.6, 0.8]") + boundary("[0.4, 0.3]", "[-0.2, 1.1]")).empty());
}

TEST_CASE("gravity needs a boundary for each body") {
  const std::string apart = soil("clay", "[[5, 0], [6, 0], [6, 2], [5, 2]]");
  CHECK(
      errors_with(apart) ==
      "box.toml:20:1: key 'soil[1]': soil 'clay' falls: gravity is applied and its body has no boundary that "
      "carries it, a fixed one or a roller that is not upright, and no soil below to land on");
  CHECK_THAT(errors_with(apart + boundary("[5, 0]", "[5, 2]")), Contains("soil 'clay' falls"));
  CHECK(errors_with(apart + boundary("[5, 0]", "[5, 2]", "fixed")).empty());
  CHECK(errors_with(apart + "[loading]\ngravity_applied = false\n").empty());
  CHECK(errors_with(apart + boundary("[5, 0]", "[6, 0]")).empty());
  CHECK(errors_with(soil("clay", "[[1, 4], [2, 4], [2, 5], [1, 5]]")).empty());  // lands on the sand
  CHECK_THAT(errors_with(soil("clay", "[[1, -4], [2, -4], [2, -3], [1, -3]]")),
             Contains("soil 'clay' falls"));
  const std::string propped = soil("clay", "[[1, 4], [2, 4], [2, 5], [1, 5]]") +
                              boundary("[1, 4]", "[2, 4]") + "name = \"prop\"\n" +
                              "[[stage]]\nname = \"drop\"\nduration = 1\nsupport_off = [\"prop\"]\n";
  CHECK(errors_with(propped).empty());
}

TEST_CASE("soils keep clear of each other or touch") {
  const auto at_x = [](const std::string& left) {
    return errors_with(soil("clay", "[[" + left + ", 0], [9, 0], [9, 2], [" + left + ", 2]]") +
                       boundary("[5, 0]", "[9, 0]"));
  };
  CHECK(
      at_x("4.2") ==
      "box.toml:22:11: key 'soil[1].polygon': soils 'sand' and 'clay' are 0.2 m apart at (4.2, 0), less than "
      "particles.spacing = 0.5 m: they must touch, or keep clear of each other");
  CHECK(at_x("4.00001").empty());
  CHECK(at_x("4.5").empty());
}

TEST_CASE("soils that touch at a point leave no slit that particles would bridge") {
  const auto below = [](const std::string& polygon) {  // the sand's top, y = 2, is 4 m long
    return errors_with(soil("clay", polygon) + "[loading]\ngravity_applied = false\n");
  };
  CHECK(below("[[0, 2], [4, 2.4], [4, 5], [0, 5]]") ==
        "box.toml:22:11: key 'soil[1].polygon': soils 'sand' and 'clay' leave a slit between them that is "
        "narrower than particles.spacing = 0.5 m over 4.02 m, at (3.90167, 2.19508): close it or "
        "widen it");
  CHECK_THAT(below("[[0, 2], [2, 2.1], [4, 2], [4, 5], [0, 5]]"), Contains("over 4.005 m"));  // a lens
  CHECK(below("[[0, 2], [4, 4], [4, 5], [0, 5]]").empty());  // 27 degrees: open after two spacings
  CHECK(below("[[0, 2], [4, 2], [4, 5], [0, 5]]").empty());
  // Filled by a third soil that tapers off.
  CHECK(errors_with(soil("silt", "[[0, 2], [4, 2], [4, 2.5]]") +
                    soil("clay", "[[0, 2], [4, 2.5], [4, 5], [0, 5]]"))
            .find("slit") == std::string::npos);
}

TEST_CASE("the number of time steps is bounded") {
  CHECK(
      errors_of(with("youngs_modulus = 1e6", "youngs_modulus = 1e15"), {"time.end=1e9"}) ==
      "override 'time.end=1e9': key 'time.end' = 1000000000: takes about 8.13e+15 time steps; at most 1e+10");
}

TEST_CASE("probes on the outline are inside") {
  const auto errors = [](const std::string& position) {
    return errors_with("[[probe]]\nname = 'A'\nposition = " + position + "\n");
  };
  CHECK(errors("[4, 2]").empty());
  CHECK(errors("[4.01, 2]") == "box.toml:22:12: key 'probe[0].position': (4.01, 2) is outside all soils");
}

TEST_CASE("the column reference needs a column") {
  const std::string column = "reference = 'column'\n" + small_case;
  const std::string walls = boundary("[0, 0]", "[0, 3]") + boundary("[4, 0]", "[4, 2]");
  const std::string at = "box.toml:1:13: key 'reference' = \"column\": ";
  CHECK(errors_of(column + walls).empty());
  CHECK(errors_of(column) == at + "needs rollers along both sides of the soil");
  CHECK(errors_of(column + walls + "[loading]\ngravity_applied = false\n") == at + "needs gravity");
  CHECK(errors_of(column + walls + "[water]\nstretches = [{x_to = 2, level = 3}]\n") ==
        at + "needs one water level over the whole soil");
  CHECK(errors_of(column + soil("clay", "[[4, 0], [6, 0], [6, 2], [4, 2]]")) ==
        at + "needs one soil without holes");
  CHECK(errors_of(column, {"soil.sand.polygon=[[0,0],[4,0],[4,2],[0,3]]"}) ==
        at + "needs a soil that is an upright rectangle");
  CHECK(errors_of(column + walls, {"boundary.0.from=[1,0]"}) == at + "needs a boundary below the soil");
}

TEST_CASE("a plate that bends is an upright rectangle, longer than thick") {
  const auto errors_of_bending = [](const std::string& outline) {
    return errors_of(with(sand_outline, outline + "\nbending_velocity = 0.1"));
  };
  const std::string at = "box.toml:9:20: key 'soil[0].bending_velocity' = 0.1: ";
  CHECK(errors_of_bending(sand_outline).empty());
  CHECK(errors_of_bending("[[0, 0], [4, 0], [4, 2], [1, 2]]") ==
        at + "needs a soil that is an upright rectangle");
  CHECK(errors_of_bending("[[0, 0], [4, 0], [4, 5], [0, 5]]") ==
        at + "needs a soil that is at least as long as it is thick");
}
