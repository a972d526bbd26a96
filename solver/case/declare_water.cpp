// The keys of the water: its levels, and how it flows.
#include <array>

#include "solver/case/case_file.hpp"
#include "solver/case/fields.hpp"
#include "solver/water/standing_water.hpp"

namespace porosph {
namespace {

using Names = std::string_view;
constexpr std::array<Names, 5> water_modes{name(WaterMode::still), name(WaterMode::steady),
                                           name(WaterMode::coupled), name(WaterMode::undrained),
                                           name(WaterMode::transient)};
constexpr std::array<Names, 3> water_motions{"quasi_static", "dynamic", "automatic"};
constexpr std::array<Names, 5> face_kinds{"head", "closed", "seepage", "flux", "rain"};

bool level_everywhere(const WaterCase& c) {
  return c.stretches.size() == 1 && c.stretches[0].x_from == -never && c.stretches[0].x_to == never;
}

void declare_coupling(Fields& f, const WaterCase& water, CouplingCase& c) {
  const auto key = [&](std::string_view name, std::string_view unit, std::string_view meaning) {
    return Key(name, unit, meaning)
        .only_if(water.flows_over_time(), "mode = \"coupled\", \"undrained\" or \"transient\"");
  };
  f.choice(
      key("motion", "",
          "`quasi_static`: the soil is at rest all the while, and the run ends where it fails; `dynamic`: it "
          "moves with its inertia, in steps that neither permeability nor `bulk_modulus` makes shorter; "
          "`automatic`: it is at rest until it fails, and moves from there on. `transient` is never "
          "`dynamic` from the start."),
      c.motion, water_motions);
  const auto in_motion = [&](std::string_view name, std::string_view meaning) {
    return Key(name, "s", meaning)
        .only_if(water.flows_over_time() && c.motion == WaterMotion::automatic, "motion = \"automatic\"");
  };
  f.number(in_motion("motion_time", "How long the soil moves after it has failed; the run then ends."),
           c.motion_time, above(0, longest));
  f.number(in_motion("motion_interval",
                     "Between frames and between rows of the history while it moves, in place of "
                     "`output.interval` and `output.history_interval`."),
           c.motion_interval, above(0, longest));
  bool incompressible = !(c.bulk_modulus < never);
  double modulus = incompressible ? CouplingCase{}.bulk_modulus : c.bulk_modulus;
  f.number_or(key("bulk_modulus", "Pa", "Of water; `incompressible`: it keeps its volume."), modulus,
              above(0, stiffest), "incompressible", incompressible);
  c.bulk_modulus = incompressible ? CouplingCase::incompressible : modulus;
  f.number(
      key("first_step", "s", "First step of the flow; with `undrained` each step, in which the loads change.")
          .otherwise(
              "coupled: spacing^2 / c_v, which water takes from one particle to the next; undrained: a "
              "hundredth of the run; transient: 0.004 spacing / k"),
      c.first_step, above(0, longest));
  f.number(Key("growth", "", "Largest ratio of a flow step to the one before it.")
               .only_if(water.flows_over_time() && water.mode != WaterMode::undrained,
                        "mode = \"coupled\" or \"transient\""),
           c.growth, between(1, 2));
  f.number(key("tolerance", "",
               "Of the error that a flow step makes in time. Coupled and undrained: over the largest excess "
               "pressure; a tenth of it may be left of forces and of changes of pressure. Transient: of "
               "saturation, root mean square."),
           c.tolerance, between(1e-6, 0.1));
  f.number(Key("stabilisation", "",
               "Keeps pressure from alternating between particles where water cannot flow: `a` of "
               "[theory](theory.md#undrained-soil); 0 is off.")
               .only_if(water.couples(), "mode = \"coupled\" or \"undrained\""),
           c.stabilisation, between(0, 1));
}

void declare_start(Fields& f, bool used, TransientCase& c) {
  const auto key = [&](std::string_view name, std::string_view unit, std::string_view meaning) {
    return Key(name, unit, meaning).only_if(used, "mode = \"transient\"");
  };
  f.number(key("start_level", "m", "y of the water table at the start, where water is at rest.")
               .otherwise("steady flow as the faces are at t = 0"),
           c.start_level, between(-farthest, farthest));
  f.number(key("start_pressure_head", "m",
               "Pressure head of the whole soil at the start; with start_level, the least that it has above "
               "the water table.")
               .otherwise("see `start_level`"),
           c.start_pressure_head, between(-1e6, 1e6));
  f.flag(
      key("rigid_soil", "",
          "Whether the soil keeps still: the flow alone is computed. Otherwise the soil comes to rest under "
          "its weight and the pore pressure at the start, from where displacements count, and again at "
          "each time of the output."),
      c.rigid);
}

}  // namespace

void declare(Fields& f, HydraulicFaceCase& c) {
  f.choice(
      Key("kind", "",
          "`head`: water stands at `level` beside it, and above that water may leave; `closed`: nothing "
          "passes; `seepage`: water leaves where its pressure reaches that of the air, and none enters; "
          "`flux`: `rate` passes; `rain`: `rate` falls, of which no more enters than at the pressure head "
          "`ponding`, and where it is negative no more evaporates than at the pressure head `driest`.")
          .required(),
      c.kind, face_kinds);
  f.point(Key("from", "m", "One end of a straight stretch of the outline; it may reach beyond it.")
              .otherwise("the whole outline"),
          c.from);
  f.point(Key("to", "m", "The other end.").otherwise("the whole outline"), c.to);
  if (c.from.allFinite() != c.to.allFinite()) f.reject("", "needs both 'from' and 'to', or none of them");
  if (c.from.allFinite() && c.from == c.to) f.reject("to", "must differ from 'from'");
  f.name(Key("name", "", "Names it in the history: `<name>.inflow`."), c.name);
  f.number(Key("level", "m", "y of the water beside it.")
               .only_if(c.kind == FaceKind::head, "kind = \"head\"")
               .otherwise("none"),
           c.level, between(-farthest, farthest));
  f.pairs(Key("level_over_time", "s, m",
              "The same over time, in place of `level`, linear between these times and constant before and "
              "after. For mode = \"transient\".")
              .only_if(c.kind == FaceKind::head, "kind = \"head\"")
              .otherwise("see `level`"),
          c.level_over_time);
  if (c.kind == FaceKind::head && c.level < never && !c.level_over_time.empty())
    f.reject("level_over_time", "takes the place of 'level': give one of them");
  if (c.kind == FaceKind::head && !(c.level < never) && c.level_over_time.empty())
    f.reject("level", "is missing: kind = \"head\" needs it");
  const bool supplied = c.kind == FaceKind::flux || c.kind == FaceKind::rain;
  f.number(
      Key("rate", "m/s",
          "Of water into the soil, per area of the face or, of rain, per area of its plan; negative: out "
          "of it.")
          .only_if(supplied, "kind = \"flux\" or \"rain\""),
      c.rate, between(-most_permeable, most_permeable));
  f.pairs(Key("rate_over_time", "s, m/s",
              "The same over time, in place of `rate`, linear between these times and constant before and "
              "after. For mode = \"transient\".")
              .only_if(supplied, "kind = \"flux\" or \"rain\"")
              .otherwise("see `rate`"),
          c.rate_over_time);
  const bool rains = c.kind == FaceKind::rain;
  f.number(
      Key("ponding", "m", "Pressure head at the face beyond which rain runs off: the depth of its pools.")
          .only_if(rains, "kind = \"rain\""),
      c.ponding, between(0, 100));
  f.number(Key("driest", "m", "Pressure head at the face below which less evaporates than `rate`.")
               .only_if(rains, "kind = \"rain\""),
           c.driest, {.min = -1e6, .max = 0, .max_included = false});
}

void declare(Fields& f, DrainCase& c) {
  f.name(Key("name", "", "Names it in the history: `<name>.inflow`.").required(), c.name);
  f.point(Key("from", "m", "One end of a straight line in the soil.").required(), c.from);
  f.set_defaults([&] { c.to = c.from; });
  f.point(Key("to", "m", "The other end.").otherwise("as `from`: a point"), c.to);
  f.number(Key("level", "m", "y of the water in it.").otherwise("open to the air: water only enters it"),
           c.level, between(-farthest, farthest));
  f.number(Key("radius", "m", "Radius of a well or pipe at a point, less than 0.163 spacings.")
               .otherwise("0.163 spacings")
               .only_if(c.from == c.to, "a drain at a point, without 'to'"),
           c.radius, above(0, farthest));
}

void declare(Fields& f, FlowSectionCase& c) {
  f.name(Key("name", "", "Names it in the history: `<name>.discharge`.").required(), c.name);
  f.point(Key("from", "m", "One end of a straight line through the soil; it may reach beyond it.").required(),
          c.from);
  f.point(
      Key("to", "m", "The other end. What flows from the left of the line to its right counts as positive.")
          .required(),
      c.to);
  if (c.from == c.to) f.reject("to", "must differ from 'from'");
}

void declare(Fields& f, WaterCase& c) {
  f.choice(
      Key("mode", "",
          "`still`: the water stands under its level; `steady`: it flows steadily between the faces "
          "[[water.face]], and the soil then comes to rest in that flow; `coupled`: saturated soil under a "
          "level gives its water away over time, at rest all the while (consolidation); `undrained`: it "
          "keeps its water; `transient`: water flows over time between the faces, also where pores are full "
          "of air in part, and the soil follows at rest."),
      c.mode, water_modes);
  f.number(Key("unit_weight", "N/m3", "Unit weight of water."), c.unit_weight, above(0, heaviest));
  const bool still = c.mode == WaterMode::still, transient = c.mode == WaterMode::transient;
  const bool levelled = still || c.couples();
  declare_coupling(f, c, c.coupling);
  declare_start(f, transient, c.transient);
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
  f.tables(
      Key("face", "",
          "What holds at a stretch of the outline of the soils where water flows; where faces overlap "
          "the later one holds. With `steady` the whole outline must be named. With `coupled` nothing passes "
          "boundaries and the rest drains, where no face says otherwise; with `transient` boundaries are "
          "closed and the rest is a seepage face.")
          .only_if(!still && c.mode != WaterMode::undrained,
                   "mode = \"steady\", \"coupled\" or \"transient\""),
      c.faces);
  f.tables(
      Key("drain", "",
          "A drain or a well in the soil: the particles within half a spacing of a line, or nearest to a "
          "point, have its head.")
          .only_if(transient || c.mode == WaterMode::steady, "mode = \"steady\" or \"transient\""),
      c.drains);
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
