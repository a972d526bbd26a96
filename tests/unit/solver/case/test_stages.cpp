// Stages that cannot be: each has a message at its key.
#include "solver/case/stages.hpp"
#include "tests/unit/solver/case/case_text.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

namespace {

// From line 20 on.
const std::string things = R"([[load]]
name = "strip"
from = [1, 2]
to = [3, 2]
pressure = 1e4
[[boundary]]
kind = "roller"
from = [0, 0]
to = [0, 2]
name = "left"
[[soil]]
name = "fill"
polygon = [[0, 2], [4, 2], [4, 4], [0, 4]]
youngs_modulus = 1e6
poissons_ratio = 0.3
unit_weight_saturated = 20e3
)";

std::string stage_text(const std::string& keys) {
  return "[[stage]]\nname = \"next\"\nduration = 1\n" + keys;
}

/// Brings the fill, which is absent before.
const std::string later_stage =
    "[[stage]]\nname = 'filled'\nduration = 1\nfill = ['fill']\nload_off = ['strip']\n";

}  // namespace

TEST_CASE("stages that cannot be") {
  struct Wrong {
    std::string keys, error;
  };
  const Wrong wrong = GENERATE(values<Wrong>({
      {"excavate = ['sandd']\n",
       "key 'stage[0].excavate[0]' = \"sandd\": no soil is called so: there are 'sand', 'fill'"},
      {"excavate = [3]\n", "key 'stage[0].excavate[0]' = 3: must be text"},
      {"excavate = 'sand'\n", "key 'stage[0].excavate' = \"sand\": must be a list of text"},
      {"fill = ['sand']\nexcavate = ['fill']\n", "soil 'fill' falls"},
      {"excavate_within = [[[9, 0], [10, 0], [10, 1]]]\n",
       "key 'stage[0].excavate_within[0]': there is no soil within this outline in this stage"},
      {"excavate_within = [[[0, 0], [1, 1], [1, 0], [0, 1]]]\n",
       "key 'stage[0].excavate_within[0]': crosses or touches itself"},
      {"excavate_within = [[[-1, -1], [9, -1], [9, 9], [-1, 9]]]\n", "key 'stage[0]': leaves no soil at all"},
      {"excavate_within = [[[0, 1], [0.3, 1], [0.3, 2], [0, 2]]]\n",
       "key 'stage[0].excavate_within': the outlines cut soil 'sand' into pieces of which one, at"},
      {"load_off = ['strop']\n",
       "key 'stage[0].load_off[0]' = \"strop\": no load is called so: there are 'strip'"},
      {"load_off = ['strip', 'strip']\n",
       "key 'stage[0].load_off[1]' = \"strip\": this load does not act in this stage"},
      {"ramp = 1\n", "key 'stage[0].ramp' = 1: is used only with load_on, load_off or footing_on"},
      {"fill_stress = 'k0'\n", "key 'stage[0].fill_stress' = \"k0\": is used only with fill"},
      {"fill = ['fill']\n", "key 'stage[0]': in stage 'next' load[0]: lies between two soils"},
      {"support_off = ['right']\n",
       "key 'stage[0].support_off[0]' = \"right\": no boundary is called so: there are 'left'"},
      {"set = ['water.levle = 3']\n",
       "key 'stage[0].set[0]' = \"water.levle = 3\": key 'water.levle' = 3: is not known"},
      {"set = ['soil.sand.youngs_modulus = -1']\n",
       "key 'stage[0].set[0]' = \"soil.sand.youngs_modulus = -1\": key 'soil[0].youngs_modulus' = -1: must "
       "be > 0"},
      {"set = ['soil.silt.youngs_modulus = 1']\n", "there is no soil 'silt'; the case has 'sand', 'fill'"},
      {"set = ['soil.sand.polygon = [[0,0],[1,0],[1,1]]']\n",
       "a stage cannot move or rename a soil: see excavate and fill"},
      {"set = ['particles.spacing = 1']\n",
       "a stage may set keys of soil, water, loading, load, footing, sheet, formulation and stop, and time.courant"},
      {"set = ['soil.sand.law = \"tresca\"']\n", "undrained_strength"},
      {"duration2 = 1\n", "key 'stage[0].duration2': is not known; did you mean 'duration'?"},
  }));
  CAPTURE(wrong.keys);
  CHECK_THAT(errors_with(things + stage_text(wrong.keys) + later_stage),
             Contains(wrong.error) && Contains("box.toml:"));
}

TEST_CASE("stages name what is there") {
  CHECK(errors_with(things + stage_text("load_off = ['strip']\nfill = ['fill']\n")) == "");
  CHECK(errors_with(things + stage_text("set = ['water.level = 3', 'loading.damping = \"adaptive\"']\n") +
                    later_stage) == "");
  CHECK_THAT(errors_with(things + stage_text("") + stage_text("") + later_stage),
             Contains("key 'stage[1].name' = \"next\": is the name of stage[0] too"));
  CHECK_THAT(errors_with("[[stage]]\nname = 'start'\nduration = 1\n"),
             Contains("is what the part of the run before the first stage is called"));
  CHECK_THAT(errors_with("[[stage]]\nname = 'a'\n"), Contains("key 'stage[0].duration': is missing"));
  CHECK_THAT(errors_with("[output]\ntimes = [2.5]\n[[stage]]\nname = 'a'\nduration = 1\n"),
             Contains("must be <= 2 s, when the last stage ends"));
}

TEST_CASE("soil, load and boundary that a stage brings are absent before") {
  const Case scene = parse_case(
      small_case + things + stage_text("fill = ['fill']\nload_off = ['strip']\nsupport_off = ['left']\n") +
          "[[stage]]\nname = 'later'\nduration = 1\nexcavate = ['fill']\nset = ['water.level = 1']\n"
          "[[stage]]\nname = 'last'\nduration = 1\nload_on = ['strip']\nramp = 0.5\nsupport_on = ['left']\n",
      "box.toml");
  StagePlan plan(scene);
  CHECK(plan.scene().soils.size() == 1);
  CHECK(plan.scene().loads.size() == 1);
  CHECK(plan.scene().boundaries.size() == 2);
  CHECK(plan.scene().time.end == 1);
  REQUIRE(plan.go_on(0.7).empty());
  CHECK(plan.scene().soils.size() == 2);
  CHECK(plan.scene().loads.empty());
  CHECK(plan.scene().boundaries.size() == 1);
  CHECK(plan.scene().time.end == 1.7);
  REQUIRE(plan.go_on(1.5).empty());
  CHECK(plan.scene().soils.size() == 1);
  CHECK(plan.scene().water.stretches[0].level == 1);
  REQUIRE(plan.go_on(2).empty());
  CHECK(plan.is_last());
  CHECK(plan.scene().boundaries.size() == 2);
  CHECK(plan.scene().loads[0].over_time == std::vector<Point>{{2, 0}, {2.5, 1}});
  CHECK(parse_case(write_case(scene), "again").stages.size() == 3);
  CHECK(write_case(parse_case(write_case(scene), "again")) == write_case(scene));
}
