// The keys of a stage: what changes from one moment of a run on.
#include <array>

#include "solver/case/fields.hpp"

namespace porosph {
namespace {

constexpr std::array<std::string_view, 2> fill_stresses{"none", "k0"};

}  // namespace

void declare(Fields& f, StageCase& c) {
  f.name(Key("name", "", "Name of the stage, unlike any other.").required(), c.name);
  f.number(
      Key("duration", "s",
          "How long it lasts at most; it ends before where it comes to rest (stop.unbalanced_force_ratio).")
          .required(),
      c.duration, above(0, longest));
  f.texts(Key("excavate", "", "Names of soils that are removed."), c.excavate);
  f.polygons(Key("excavate_within", "m", "Outlines within which all soil is removed."), c.excavate_within);
  f.texts(Key("fill", "",
              "Names of soils that are placed, on the ground as it then lies. A soil that stages fill before "
              "they excavate it is absent until then."),
          c.fill);
  f.choice(Key("fill_stress", "",
               "How the stress of these begins: `none`, or `k0`, the K0 stress under the soil above.")
               .only_if(!c.fill.empty(), "fill"),
           c.fill_stress, fill_stresses);
  f.texts(Key("load_on", "",
              "Names of loads that act from here; absent before. Their over_time counts from here."),
          c.load_on);
  f.texts(Key("load_off", "", "Names of loads that end."), c.load_off);
  f.texts(
      Key("footing_on", "",
          "Names of footings that are placed on the ground as it then lies; absent before. Their over_time "
          "and their settlement count from here."),
      c.footing_on);
  f.texts(Key("footing_off", "", "Names of footings that are lifted off."), c.footing_off);
  f.texts(Key("sheet_on", "",
              "Names of sheets that are placed, without force, in the soil as it then lies; absent before."),
          c.sheet_on);
  f.texts(Key("sheet_off", "", "Names of sheets that are pulled out."), c.sheet_off);
  f.number(Key("ramp", "s",
               "How long these loads take to come, or to go, and the force of these footings to come.")
               .only_if(!c.load_on.empty() || !c.load_off.empty() || !c.footing_on.empty(),
                        "load_on, load_off or footing_on"),
           c.ramp, between(0, longest));
  f.texts(Key("support_on", "", "Names of boundaries that hold from here; absent before."), c.support_on);
  f.texts(Key("support_off", "", "Names of boundaries that are removed."), c.support_off);
  f.texts(Key("set", "",
              "Keys of the case that have another value from here, as [\"water.level = 2\", "
              "\"soil.clay.cohesion = 3e3\"]: of `soil` (but not where it is), `water`, `loading`, `load`, "
              "`footing`, `sheet`, `formulation` (but not its motion) and `stop`, and time.courant. Times in "
              "what is "
              "set count from "
              "here."),
          c.set);
  f.flag(Key("reset_displacements", "", "Whether displacements count from here."), c.reset_displacements);
  f.flag(
      Key("safety", "",
          "Whether the factor of safety of its last state is found, once it has come to rest or to its end "
          "(docs/safety.md)."),
      c.safety);
  f.number(Key("safety_bracket", "",
               "How close to each other the factors shall be at which the soil rests and fails.")
               .only_if(c.safety, "safety = true"),
           c.safety_bracket, between(1e-4, 1));
}

}  // namespace porosph
