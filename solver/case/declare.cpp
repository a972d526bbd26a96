// Every key of a case: name, unit, meaning, range; those of soils, water and formulation have files of their
// own. Defaults are those of the structs in case.hpp.
#include <array>
#include <cmath>

#include "solver/case/case_file.hpp"
#include "solver/case/check_loads.hpp"
#include "solver/case/fields.hpp"
#include "solver/case/outline_edges.hpp"

namespace porosph {
namespace {

using Names = std::string_view;
constexpr std::array<Names, 6> arrangements{"automatic",  "lattice", "fitted",
                                            "disordered", "surface", "stretched"};
constexpr std::array<Names, 4> boundary_kinds{"roller", "fixed", "friction", "periodic"};
constexpr std::array<Names, 3> sheet_ends{"free", "pinned", "fixed"};
constexpr std::array<Names, 2> frame_formats{"vtp", "vtu"};
constexpr std::array<Names, 3> compressions{"none", "lz4", "zlib"};
constexpr std::array<Names, 2> frame_precisions{"double", "single"};
constexpr std::array<Names, 3> references{"none", "column", "conventional_column"};

constexpr double not_given = 0;  // a smoothing ratio that the rest of the case decides

/// By the maps of docs/stability.md; the paper's lattices have 1.2. Soil that flows around the edge of a
/// footing needs more neighbours than h = dx has (docs/theory.md).
double default_smoothing_ratio(const Case& c) {
  const Arrangement arrangement = c.particles.arrangement;
  const bool fits = arrangement == Arrangement::surface || arrangement == Arrangement::stretched;
  return fits && !footing_on_soil_that_may_yield(c) ? 1 : 1.2;
}

void declare_names(Fields& f, Case& c) {
  f.text(Key("title", "", "Shown on pictures and reports."), c.title);
  f.text(Key("label", "",
             "Names the run in pictures, comparisons and reports, where `--label` does not; else its folder "
             "does."),
         c.label);
  f.choice(
      Key("reference", "",
          "Exact solution that the final state is compared with. `column`: one soil under level ground and "
          "level water between two rollers."),
      c.reference, references);
  f.text(
      Key("start_from", "",
          "Folder of a run whose last state this one begins with: soils of the same name, drawn and filled "
          "with particles in the same way, keep their stress, displacement and what they remember.")
          .otherwise("none"),
      c.start_from);
}

}  // namespace

std::string Range::text() const {
  const std::string low = min == -never ? "" : fmt::format("{} {:.6g}", min_included ? ">=" : ">", min);
  const std::string high = max == never ? "" : fmt::format("{} {:.6g}", max_included ? "<=" : "<", max);
  if (low.empty() && high.empty()) return "any";
  return low + (low.empty() || high.empty() ? "" : " and ") + high;
}

std::string_view arrangement_name(Arrangement arrangement) {
  return arrangements[static_cast<std::size_t>(arrangement)];
}

void declare(Fields& f, Case& c) {
  declare_names(f, c);
  f.table(Key("particles", "", "How particles fill the soils."), c.particles);
  f.tables(Key("soil", "", "A soil: where it is and what it is.").required(), c.soils);
  f.table(Key("water", "",
              "Water in the pores: at rest below its level, or flowing. Without this table all is dry."),
          c.water, c.water.present() || c.water.flows());
  f.tables(
      Key("boundary", "",
          "A straight segment on the outline of the soils, at any angle. It may extend beyond the "
          "soil. Boundaries may meet at any angle at which the soil between them has 30 degrees or more."),
      c.boundaries);
  f.tables(
      Key("load", "",
          "A force on the soil's surface: on a straight stretch of a free outline, as it is at the start, "
          "linear from one end to the other."),
      c.loads);
  f.tables(
      Key("footing", "",
          "A rigid plate on a straight stretch of a free outline. It moves straight into the soil, without "
          "turning, by its `force` or by its `settlement`; the soil sticks to it."),
      c.footings);
  f.tables(
      Key("sheet", "",
          "An elastic plate along a level or upright straight line: a sheet pile wall, a geotextile. Soil "
          "presses on both of its sides, and slides along them against friction. See docs/stages.md."),
      c.sheets);
  f.set_defaults([&] {
    if (c.particles.arrangement == Arrangement::automatic) c.particles.arrangement = arrangement_for(c);
    if (c.particles.smoothing_ratio == not_given) c.particles.smoothing_ratio = default_smoothing_ratio(c);
  });
  f.table(Key("formulation", "", "The discrete momentum equation and its artificial terms."), c.formulation);
  f.table(Key("loading", "", "Gravity, initial stress and damping."), c.loading);
  f.table(
      Key("shaking", "",
          "Acceleration of the base and all other supports, to the side: an earthquake. Displacements and "
          "velocities are relative to the base. See docs/shaking.md."),
      c.shaking, c.shaking.acts());
  f.table(Key("time", "", "End time and time step."), c.time);
  f.set_defaults([&] {
    c.stop.on_separation =
        std::ranges::all_of(c.soils, [](const SoilCase& s) { return s.law == LawKind::elastic; });
  });
  f.table(Key("stop", "", "When a run ends before its time."), c.stop);
  f.table(Key("check", "", "What the result is held against by itself."), c.check);
  f.table(Key("output", "", "What is written, and when."), c.output);
  f.tables(Key("probe", "", "A point of the soil whose history is recorded."), c.probes);
  f.tables(Key("section", "", "A line through the soil that the water which flows through it is counted at.")
               .only_if(c.water.mode == WaterMode::steady || c.water.mode == WaterMode::transient,
                        "water.mode = \"steady\" or \"transient\""),
           c.sections);
  f.tables(
      Key("stage", "",
          "What changes next, once the run has come to rest or to its end as the tables above say: stages "
          "follow each other in the order of the file. See docs/stages.md."),
      c.stages);
}

void declare(Fields& f, ParticlesCase& c) {
  f.number(Key("spacing", "m", "Distance of neighbouring particles, dx.").required(), c.spacing,
           above(0, farthest));
  f.set_defaults([&] { c.arrangement = Arrangement::automatic; });
  f.choice(
      Key("arrangement", "",
          "`surface`: cells with their middle on free surfaces and their ends at walls (with "
          "smoothing_ratio = 1 a linear stress is then exact); `stretched`: cells stretched so that whole "
          "ones "
          "fit between level and upright stretches of the outline, clipped where it slopes; `automatic`: "
          "`surface` where all outlines are level or upright and all free ones level, else `stretched`; "
          "`fitted`: square cells clipped by the outline; `lattice`: square cells with their centre in the "
          "soil; `disordered`: cells around randomly displaced points. All carry the soil's drawn volume.")
          .otherwise("automatic"),
      c.arrangement, arrangements);
  f.set_defaults([&] { c.smoothing_ratio = not_given; });
  f.number(
      Key("smoothing_ratio", "", "Smoothing length over spacing, h / dx.")
          .otherwise("1, but 1.2 with lattice, fitted and disordered, and where a footing stands in a case "
                     "with soil that may yield"),
      c.smoothing_ratio, between(0.8, 3));
  const bool disordered = c.arrangement == Arrangement::disordered;
  f.number(Key("disorder", "", "Largest random displacement over spacing.")
               .only_if(disordered, "arrangement = \"disordered\""),
           c.disorder, between(0, 0.5));
  f.integer(Key("seed", "", "Seed of the random displacements.")
                .only_if(disordered, "arrangement = \"disordered\""),
            c.seed, between(0, 999999));
}

void declare(Fields& f, BoundaryCase& c) {
  f.choice(
      Key("kind", "",
          "`roller`: free to slide along it; `fixed`: no motion; `friction`: sliding along it only where the "
          "shear stress reaches `coefficient` times the normal effective stress; `periodic`: one of the two "
          "upright sides of level layers, behind each of which soil and water continue as they begin at the "
          "other (docs/shaking.md).")
          .required(),
      c.kind, boundary_kinds);
  const bool rubs = c.kind == BoundaryKind::friction;
  Key coefficient =
      Key("coefficient", "", "Coefficient of friction: the tangent of the angle of wall friction.")
          .only_if(rubs, "kind = \"friction\"")
          .otherwise("required");
  coefficient.is_required = rubs;
  f.number(coefficient, c.coefficient, between(0, 10));
  f.point(Key("from", "m", "One end.").required(), c.from);
  f.point(Key("to", "m", "The other end.").required(), c.to);
  f.name(Key("name", "", "By which [[stage]] calls it.").otherwise("none"), c.name);
}

void declare(Fields& f, LoadCase& c) {
  f.name(Key("name", "", "Name of the load, unlike any other.").required(), c.name);
  f.point(Key("from", "m", "One end of the stretch.").required(), c.from);
  f.point(Key("to", "m", "The other end.").required(), c.to);
  f.number(Key("pressure", "Pa", "Pressure at `from`, into the soil."), c.pressure,
           between(-stiffest, stiffest));
  f.set_defaults([&] { c.pressure_to = c.pressure; });
  f.number(Key("pressure_to", "Pa", "Pressure at `to`.").otherwise("as pressure"), c.pressure_to,
           between(-stiffest, stiffest));
  f.point(Key("traction", "Pa", "Force per area at `from` in any direction, in addition."), c.traction);
  f.set_defaults([&] { c.traction_to = c.traction; });
  f.point(Key("traction_to", "Pa", "That at `to`.").otherwise("as traction"), c.traction_to);
  f.pairs(Key("over_time", "s, -",
              "Factor of the load over time, [[t, factor], ...]: linear between these times and constant "
              "before and after.")
              .otherwise("1 at all times"),
          c.over_time);
}

void declare(Fields& f, FootingCase& c) {
  f.name(Key("name", "", "Name of the footing, unlike any other.").required(), c.name);
  f.point(Key("from", "m", "One end of the stretch.").required(), c.from);
  f.point(Key("to", "m", "The other end.").required(), c.to);
  f.flag(Key("rough", "", "`false`: the soil slides along the footing without friction."), c.rough);
  f.number(
      Key("force", "N/m", "Force that presses it into the soil, per metre of thickness.").otherwise("none"),
      c.force, between(-stiffest, stiffest));
  f.number(Key("settlement", "m", "Way into the soil that it is driven by.").otherwise("none"), c.settlement,
           between(-farthest, farthest));
  f.pairs(Key("over_time", "s, -",
              "Factor of force or settlement over time, [[t, factor], ...]: linear between these times and "
              "constant before and after.")
              .otherwise("1 at all times"),
          c.over_time);
}

void declare(Fields& f, SheetCase& c) {
  f.name(Key("name", "", "Name of the sheet, unlike any other.").required(), c.name);
  f.point(Key("from", "m", "One end.").required(), c.from);
  f.point(Key("to", "m", "The other end, straight above, below or beside it.").required(), c.to);
  f.number(
      Key("bending_stiffness", "N*m", "E I per metre of thickness: 0 for a geotextile, which does not bend.")
          .required(),
      c.bending_stiffness, between(0, stiffest));
  f.number(Key("axial_stiffness", "N/m", "E A per metre of thickness.").required(), c.axial_stiffness,
           above(0, stiffest));
  f.number(Key("mass", "kg/m2", "Mass per area; it has weight and inertia.").required(), c.mass,
           above(0, heaviest));
  f.flag(Key("bonded", "", "`true`: the soil neither slides along the sheet nor comes off it."), c.bonded);
  f.number(Key("friction", "",
               "Shear over normal effective stress at most between soil and sheet: the tangent of the angle "
               "of wall friction.")
               .only_if(!c.bonded, "bonded = false"),
           c.friction, between(0, 10));
  f.number(Key("adhesion", "Pa", "Shear stress that soil and sheet bear in addition, while they touch.")
               .only_if(!c.bonded, "bonded = false"),
           c.adhesion, between(0, stiffest));
  f.choice(Key("from_end", "",
               "How the end `from` is held: `free`, `pinned` where it was placed, or `fixed` there, so that "
               "it cannot turn."),
           c.from_end, sheet_ends);
  f.choice(Key("to_end", "", "How the end `to` is held."), c.to_end, sheet_ends);
}

void declare(Fields& f, LoadingCase& c) {
  f.number(Key("gravity", "m/s2", "g, downwards; it also turns unit weights into densities."), c.gravity,
           above(0, 1e6));
  f.flag(Key("gravity_applied", "", "`false`: a weightless scene."), c.gravity_applied);
  f.flag(Key("k0_stress", "", "Whether to start from the K0 stress instead of none.")
             .only_if(c.gravity_applied, "gravity_applied = true"),
         c.k0_stress);
  f.number(Key("k0", "", "Horizontal over vertical effective stress.")
               .only_if(c.k0_stress, "k0_stress = true")
               .otherwise("nu / (1 - nu) of each soil"),
           c.k0, between(0, 10));
  f.number_or(
      Key("damping", "",
          "xi of eq. (34): the damping force per mass and velocity is xi / dt; 0: off. `adaptive`: critical "
          "for the lowest vibration that the motion contains, to come to rest soonest."),
      c.damping, between(0, 1), "adaptive", c.adaptive_damping);
  f.number(Key("damping_until", "s", "When the damping ends.")
               .only_if(c.damping > 0 || c.adaptive_damping, "damping > 0")
               .otherwise("never"),
           c.damping_until, above(0, longest));
  f.flag_or(
      Key("scaled_inertia", "",
          "Whether stiff soils get inertia beyond their mass on the way to rest, so that none has "
          "faster waves than the softest: time steps are longer then, and time has no meaning. `\"auto\"`: "
          "where only the "
          "state of rest of elastic soil is asked for and soils differ enough (docs/theory.md); `true`: an "
          "error where more is asked for; `false`: soil moves by its mass."),
      c.scaled_inertia, "auto", c.scaled_inertia_auto);
  f.number(
      Key("horizontal", "",
          "Acceleration to the right over g that acts on the soil beside gravity: the coefficient k_h of a "
          "pseudo-static earthquake.")
          .only_if(c.gravity_applied, "gravity_applied = true"),
      c.horizontal, between(-10, 10));
}

void declare(Fields& f, ShakingCase& c) {
  f.pairs(
      Key("acceleration_over_time", "s, m/s2",
          "Acceleration of the base to the right, [[t, a], ...], in place of a sine: linear between these "
          "times and constant before and after.")
          .otherwise("see `amplitude`"),
      c.acceleration_over_time);
  const bool any = !c.acceleration_over_time.empty();
  const std::string condition = "no acceleration_over_time";
  Key amplitude = Key("amplitude", "m/s2",
                      "Largest acceleration of a sine, a sin(2 pi f (t - start)); to the right first.")
                      .only_if(!any, condition)
                      .otherwise("required");
  amplitude.is_required = !any;
  f.number(amplitude, c.amplitude, between(0, 1e6));
  const bool sine = c.amplitude > 0;
  Key frequency =
      Key("frequency", "Hz", "f of the sine.").only_if(sine, "amplitude > 0").otherwise("required");
  frequency.is_required = sine;
  f.number(frequency, c.frequency, above(0, 1e6));
  f.number(Key("cycles", "", "How many cycles of the sine there are.")
               .only_if(sine, "amplitude > 0")
               .otherwise("until the run ends"),
           c.cycles, above(0, 1e9));
  f.number(
      Key("ramp", "",
          "Cycles in which the sine grows linearly from nothing, and in which it falls to nothing at its "
          "end; at most half of all cycles.")
          .only_if(sine, "amplitude > 0"),
      c.ramp, between(0, 1e9));
  if (sine && c.ramp > c.cycles / 2)
    f.reject("ramp", fmt::format("must be <= cycles / 2 = {:g}", c.cycles / 2));
  f.number(Key("start", "s", "When the sine begins.").only_if(sine, "amplitude > 0"), c.start,
           between(0, longest));
}

void declare(Fields& f, TimeCase& c) {
  f.number(Key("end", "s", "When the run ends.").required(), c.end, above(0, longest));
  f.number(Key("courant", "", "dt = courant * h / c_p, c_p the fastest compression wave."), c.courant,
           above(0, 10));
  f.number(
      Key("step", "s",
          "Time step, at most the one that `courant` allows; the run then ends with the first step at or "
          "after `end`. A run that was resumed to a later end has one: the step that it began with.")
          .otherwise("that of `courant`, rounded down so that whole steps reach `end`"),
      c.step, above(0, longest));
}

void declare(Fields& f, StopCase& c) {
  f.number(Key("unbalanced_force_ratio", "", "Equilibrium when the ratio has fallen below this; 0: never."),
           c.unbalanced_force_ratio, between(0, 1));
  f.flag(Key("on_separation", "", "Whether the run is unstable once particles have left the body.")
             .otherwise("true, but false where a soil yields"),
         c.on_separation);
  f.number(Key("displacement", "m",
               "The soil has failed, and the run ends, once a particle has moved further than this.")
               .otherwise("never"),
           c.displacement, above(0, farthest));
}

void declare(Fields& f, CheckCase& c) {
  f.flag_or(
      Key("finite_elements", "",
          "Whether the state of rest is compared with finite elements of small strain (docs/reports.md). "
          "`\"auto\"`: where they apply and cost less than a second or a tenth of the run; `true`: always, "
          "an error "
          "where "
          "they do not apply."),
      c.finite_elements, "auto", c.finite_elements_auto);
}

void declare(Fields& f, OutputCase& c) {
  static const std::vector<std::string> known = [] {
    std::vector<std::string> all;
    for (const Field& field : field_table()) all.emplace_back(field.name);
    return all;
  }();
  f.number(Key("interval", "s", "Time between frames; 0: first and last only."), c.interval,
           between(0, longest));
  f.numbers(Key("times", "s", "Times of further frames, each written at the nearest step."), c.times,
            between(0, longest));
  f.number(Key("history_interval", "s", "Time between rows of the history; 0: every step."),
           c.history_interval, between(0, longest));
  f.words(Key("fields", "", "Particle data of the frames; only these are computed for output."), c.fields,
          known);
  f.flag(Key("boundary", "", "Whether the mirror particles behind the walls are written, as a second block."),
         c.boundary);
  f.choice(Key("format", "", "Format of the frames: PolyData (`vtp`) or UnstructuredGrid (`vtu`)."), c.format,
           frame_formats);
  f.choice(Key("compression", "",
               "Compression of the frames; `zlib` is the smallest, `lz4` and `none` are faster."),
           c.compression, compressions);
  f.choice(
      Key("precision", "",
          "Precision of the frames' fields; `single` has 7 digits and about half the bytes. Positions are "
          "always `double`, and the run itself does not depend on it."),
      c.precision, frame_precisions);
}

void declare(Fields& f, ProbeCase& c) {
  f.name(Key("name", "", "Name of the probe, unlike any other.").required(), c.name);
  f.point(Key("position", "m", "Position at the start; the probe then moves with the soil.").required(),
          c.position);
}

}  // namespace porosph
