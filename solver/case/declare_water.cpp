// The keys of the water: its levels, and how it flows.
#include <array>

#include "solver/case/case_file.hpp"
#include "solver/case/fields.hpp"
#include "solver/water/standing_water.hpp"

namespace porosph {
namespace {

using Names = std::string_view;
constexpr std::array<Names, 4> water_modes{name(WaterMode::still), name(WaterMode::steady),
                                           name(WaterMode::coupled), name(WaterMode::undrained)};
constexpr std::array<Names, 4> face_kinds{"head", "closed", "seepage", "flux"};

bool level_everywhere(const WaterCase& c) {
  return c.stretches.size() == 1 && c.stretches[0].x_from == -never && c.stretches[0].x_to == never;
}

void declare_coupling(Fields& f, const WaterCase& water, CouplingCase& c) {
  const auto key = [&](std::string_view name, std::string_view unit, std::string_view meaning) {
    return Key(name, unit, meaning).only_if(water.couples(), "mode = \"coupled\" or \"undrained\"");
  };
  bool incompressible = !(c.bulk_modulus < never);
  double modulus = incompressible ? CouplingCase{}.bulk_modulus : c.bulk_modulus;
  f.number_or(key("bulk_modulus", "Pa", "Of water; `incompressible`: it keeps its volume."), modulus,
              above(0, stiffest), "incompressible", incompressible);
  c.bulk_modulus = incompressible ? CouplingCase::incompressible : modulus;
  f.number(
      key("first_step", "s", "First step of the flow; with `undrained` each step, in which the loads change.")
          .otherwise("spacing^2 / c_v, which water takes from one particle to the next; with "
                     "`undrained` a hundredth of the run"),
      c.first_step, above(0, longest));
  f.number(Key("growth", "", "Largest ratio of a flow step to the one before it.")
               .only_if(water.mode == WaterMode::coupled, "mode = \"coupled\""),
           c.growth, between(1, 2));
  f.number(key("tolerance", "",
               "Of the error that a flow step makes in time, over the largest excess pressure; a tenth of it "
               "may be left of forces and of changes of pressure."),
           c.tolerance, between(1e-6, 0.1));
  f.number(key("stabilisation", "",
               "Keeps pressure from alternating between particles where water cannot flow: `a` of "
               "[theory](theory.md#undrained-soil); 0 is off."),
           c.stabilisation, between(0, 1));
}

}  // namespace

void declare(Fields& f, HydraulicFaceCase& c) {
  f.choice(Key("kind", "",
               "`head`: water stands at `level` beside it, and above that water may leave; `closed`: nothing "
               "passes; `seepage`: water leaves where its pressure reaches that of the air, and none enters; "
               "`flux`: `rate` passes.")
               .required(),
           c.kind, face_kinds);
  f.point(Key("from", "m", "One end of a straight stretch of the outline; it may reach beyond it.")
              .otherwise("the whole outline"),
          c.from);
  f.point(Key("to", "m", "The other end.").otherwise("the whole outline"), c.to);
  if (c.from.allFinite() != c.to.allFinite()) f.reject("", "needs both 'from' and 'to', or none of them");
  if (c.from.allFinite() && c.from == c.to) f.reject("to", "must differ from 'from'");
  f.number(Key("level", "m", "y of the water beside it.")
               .only_if(c.kind == FaceKind::head, "kind = \"head\"")
               .otherwise("none"),
           c.level, between(-farthest, farthest));
  if (c.kind == FaceKind::head && !(c.level < never))
    f.reject("level", "is missing: kind = \"head\" needs it");
  f.number(Key("rate", "m/s", "Of water into the soil per area of the face; negative: out of it.")
               .only_if(c.kind == FaceKind::flux, "kind = \"flux\""),
           c.rate, between(-most_permeable, most_permeable));
}

void declare(Fields& f, WaterCase& c) {
  f.choice(
      Key("mode", "",
          "`still`: the water stands under its level; `steady`: it flows steadily between the faces "
          "[[water.face]], and the soil then comes to rest in that flow; `coupled`: saturated soil under a "
          "level gives its water away over time, at rest all the while (consolidation); `undrained`: it "
          "keeps "
          "its water."),
      c.mode, water_modes);
  f.number(Key("unit_weight", "N/m3", "Unit weight of water."), c.unit_weight, above(0, heaviest));
  const bool still = c.mode == WaterMode::still, levelled = c.mode != WaterMode::steady;
  const bool faces = c.mode == WaterMode::steady || c.mode == WaterMode::coupled;
  declare_coupling(f, c, c.coupling);
  f.tables(Key("face", "",
               "What holds at a stretch of the outline of the soils where water flows; where faces overlap "
               "the later "
               "one holds. With `steady` the whole outline must be named. With `coupled` nothing passes "
               "boundaries "
               "and the rest drains, where no face says otherwise.")
               .only_if(faces, "mode = \"steady\" or \"coupled\""),
           c.faces);
  const bool moves = !c.level_over_time.empty();
  double level = level_everywhere(c) && !moves ? c.stretches[0].level : never;
  std::vector<WaterStretch> stretches = level_everywhere(c) ? std::vector<WaterStretch>{} : c.stretches;
  f.number(Key("level", "m", "y of the free surface, the same everywhere.")
               .only_if(levelled, "mode = \"still\", \"coupled\" or \"undrained\"")
               .otherwise("see `stretches`"),
           level, between(-farthest, farthest));
  f.tables(Key("stretches", "",
               "A stretch of the free surface, in place of one `level`; soil outside all stretches "
               "is dry. One that ends at an upright face of a soil presses on that face.")
               .only_if(still, "mode = \"still\""),
           stretches);
  f.pairs(Key("level_over_time", "s, m",
              "A free surface that rises and falls, in place of one `level`: its y over time, linear between "
              "these times and constant before and after. Soil keeps the weight that it has at the start.")
              .only_if(still, "mode = \"still\"")
              .otherwise("see `level`"),
          c.level_over_time);
  if (!levelled) return;
  if ((level < never) + !stretches.empty() + !c.level_over_time.empty() != 1)
    f.reject("", "needs one of 'level', 'stretches' and 'level_over_time'");
  if (!c.level_over_time.empty()) level = level_at(c, 0);
  c.stretches = level < never ? std::vector<WaterStretch>{{-never, never, level}} : std::move(stretches);
}

void declare(Fields& f, WaterStretch& c) {
  f.number(Key("x_from", "m", "Left end.").otherwise("no end"), c.x_from, between(-farthest, farthest));
  f.number(Key("x_to", "m", "Right end.").otherwise("no end"), c.x_to, between(-farthest, farthest));
  if (c.x_to <= c.x_from) f.reject("x_to", fmt::format("must be > x_from = {} m", c.x_from));
  f.number(Key("level", "m", "y of the free surface.").required(), c.level, between(-farthest, farthest));
}

}  // namespace porosph
