// Every key of a case: name, unit, meaning, range. Defaults are those of the structs in case.hpp.
#include <array>
#include <cmath>

#include "solver/case/case_file.hpp"
#include "solver/case/fields.hpp"
#include "solver/case/outline_edges.hpp"
#include "solver/water/standing_water.hpp"

namespace porosph {
namespace {

using Names = std::string_view;
constexpr std::array<Names, 6> arrangements{"automatic",  "lattice", "fitted",
                                            "disordered", "surface", "stretched"};
constexpr std::array<Names, 2> boundary_kinds{"roller", "fixed"};
constexpr std::array<Names, 4> motions{"conventional", "proposed", "rho_squared", "consistent"};
constexpr std::array<Names, 2> frame_formats{"vtp", "vtu"};
constexpr std::array<Names, 3> compressions{"none", "lz4", "zlib"};
constexpr std::array<Names, 3> water_modes{"still", "steady", "coupled"};
constexpr std::array<Names, 4> face_kinds{"head", "closed", "seepage", "flux"};
constexpr std::array<Names, 3> retention_models{"saturated", "gardner", "van_genuchten"};
constexpr std::array<Names, 3> references{"none", "column", "conventional_column"};
constexpr std::array<Names, 4> laws{"elastic", "drucker_prager", "mohr_coulomb", "tresca"};
constexpr double steepest = 80;  // degrees
constexpr std::array<Names, 3> softenings{"none", "exponential", "linear"};

bool level_everywhere(const WaterCase& c) {
  return c.stretches.size() == 1 && c.stretches[0].x_from == -never && c.stretches[0].x_to == never;
}

/// By the maps of docs/stability.md; the paper's lattices have 1.2.
double default_smoothing_ratio(Arrangement arrangement) {
  const bool fits = arrangement == Arrangement::automatic || arrangement == Arrangement::surface ||
                    arrangement == Arrangement::stretched;
  return fits ? 1 : 1.2;
}

/// A key that its soil must have; in the documents as well, where no soil is given.
Key required_if(bool used, std::string_view name, std::string_view unit, std::string_view meaning,
                std::string condition) {
  Key key = Key(name, unit, meaning).only_if(used, std::move(condition)).otherwise("required");
  key.is_required = used;
  return key;
}

void declare_friction(Fields& f, bool used, StrengthCase& c) {
  const std::string condition = "law = \"drucker_prager\" or \"mohr_coulomb\"";
  f.number(required_if(used, "cohesion", "Pa", "Cohesion c, of effective stress.", condition), c.cohesion,
           between(0, stiffest));
  f.number(
      required_if(used, "friction_angle", "degrees", "Friction angle phi, of effective stress.", condition),
      c.friction_angle, between(0, steepest));
  f.number(
      Key("dilation_angle", "degrees", "Dilation angle psi of plastic flow; not more than friction_angle.")
          .only_if(used, condition),
      c.dilation_angle, between(0, steepest));
  if (used && c.dilation_angle > c.friction_angle)
    f.reject("dilation_angle", fmt::format("must be <= friction_angle = {} degrees", c.friction_angle));
}

void declare_undrained(Fields& f, bool used, StrengthCase& c) {
  const std::string condition = "law = \"tresca\"";
  f.number(required_if(used, "undrained_strength", "Pa",
                       "Undrained shear strength c_u, at `undrained_strength_level` and above.", condition),
           c.undrained_strength, above(0, stiffest));
  f.number(
      Key("undrained_strength_growth", "Pa/m",
          "By how much c_u grows with depth below `undrained_strength_level`; soil keeps the strength of "
          "where it is at the start.")
          .only_if(used, condition),
      c.growth, between(0, stiffest));
  f.number(Key("undrained_strength_level", "m", "y from which c_u grows.")
               .only_if(used && c.growth > 0, "undrained_strength_growth > 0")
               .otherwise("the soil's highest point"),
           c.level, between(-farthest, farthest));
}

void declare_softening(Fields& f, bool frictional, bool undrained, StrengthCase& c) {
  const bool used = frictional || undrained;
  f.choice(
      Key("softening", "",
          "How strength falls with plastic shear strain, and dilation to nothing with it. `exponential`: "
          "by 1 - 1/e at `softening_strain`; `linear`: to its end at `softening_strain`.")
          .only_if(used, "law = one that yields"),
      c.softening, softenings);
  const bool softens = used && c.softening != SofteningKind::none;
  const std::string condition = "softening = \"exponential\" or \"linear\"";
  f.number(
      required_if(softens, "softening_strain", "",
                  "Plastic shear strain in a band of `softening_length` by which strength falls.", condition),
      c.softening_strain, above(0, 1e6));
  f.number(
      required_if(softens, "softening_length", "m",
                  "Width of the shear bands in which `softening_strain` holds. Bands are a few particles "
                  "wide, so plastic strain counts by spacing over this length: results then do not hang "
                  "on the spacing.",
                  condition),
      c.softening_length, above(0, farthest));
  f.number(Key("residual_cohesion", "Pa", "Cohesion that softening leaves; not more than cohesion.")
               .only_if(frictional && softens, condition)
               .otherwise("0"),
           c.residual_cohesion, between(0, stiffest));
  if (softens && frictional && c.residual_cohesion > c.cohesion)
    f.reject("residual_cohesion", fmt::format("must be <= cohesion = {} Pa", c.cohesion));
  f.set_defaults([&] { c.residual_friction_angle = c.friction_angle; });
  f.number(Key("residual_friction_angle", "degrees",
               "Friction angle that softening leaves; not more than friction_angle.")
               .only_if(frictional && softens, condition)
               .otherwise("friction_angle"),
           c.residual_friction_angle, between(0, steepest));
  if (softens && frictional && c.residual_friction_angle > c.friction_angle)
    f.reject("residual_friction_angle",
             fmt::format("must be <= friction_angle = {} degrees", c.friction_angle));
  f.number(Key("sensitivity", "", "Undrained strength over what softening leaves of it.")
               .only_if(undrained && softens, condition + " and law = \"tresca\""),
           c.sensitivity, above(1, 1e6));
}

/// Of a soil with this law.
void declare_strength(Fields& f, LawKind law, StrengthCase& c) {
  const bool frictional = law == LawKind::drucker_prager || law == LawKind::mohr_coulomb;
  const bool undrained = law == LawKind::tresca;
  declare_friction(f, frictional, c);
  declare_undrained(f, undrained, c);
  f.number(
      Key("tensile_strength", "Pa",
          "Tension that the soil bears at most: of the mean stress with `drucker_prager`, of the largest "
          "principal stress with the others.")
          .only_if(frictional || undrained, "law = one that yields")
          .otherwise("what cohesion and friction give; with `tresca` any"),
      c.tensile_strength, between(0, stiffest));
  declare_softening(f, frictional, undrained, c);
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

std::string_view law_name(LawKind law) { return laws[static_cast<std::size_t>(law)]; }

std::string_view motion_name(Motion motion) { return motions[static_cast<std::size_t>(motion)]; }

// Strengths of the artificial terms as in Bui et al. 2008 (Int. J. Numer. Anal. Meth. Geomech. 32).
FormulationCase default_formulation(Motion motion) {
  FormulationCase c;
  c.motion = motion;
  if (motion == Motion::consistent) {
    c.bulk_viscosity = 0.06;
    c.zero_energy_control = 0.2;  // both by the map cases/stability/refresh_zero_energy.toml
    c.refresh_strain = 0.02;
  } else {
    c.artificial_viscosity_alpha = 0.1;
  }
  return c;
}

void declare(Fields& f, Case& c) {
  f.text(Key("title", "", "Shown on pictures and reports."), c.title);
  f.choice(
      Key("reference", "",
          "Exact solution that the final state is compared with. `column`: one soil under level ground and "
          "level water between two rollers."),
      c.reference, references);
  f.table(Key("particles", "", "How particles fill the soils."), c.particles);
  f.tables(Key("soil", "", "A soil: where it is and what it is.").required(), c.soils);
  f.table(
      Key("water", "",
          "Water in the pores: at rest below its level, or in steady flow. Without this table all is dry."),
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
  f.set_defaults([&] {
    if (c.particles.arrangement == Arrangement::automatic) c.particles.arrangement = arrangement_for(c);
  });
  f.table(Key("formulation", "", "The discrete momentum equation and its artificial terms."), c.formulation);
  f.table(Key("loading", "", "Gravity, initial stress and damping."), c.loading);
  f.table(Key("time", "", "End time and time step."), c.time);
  f.set_defaults([&] {
    c.stop.on_separation =
        std::ranges::all_of(c.soils, [](const SoilCase& s) { return s.law == LawKind::elastic; });
  });
  f.table(Key("stop", "", "When a run ends before its time."), c.stop);
  f.table(Key("check", "", "What the result is held against by itself."), c.check);
  f.table(Key("output", "", "What is written, and when."), c.output);
  f.tables(Key("probe", "", "A point of the soil whose history is recorded."), c.probes);
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
  f.set_defaults([&] { c.smoothing_ratio = default_smoothing_ratio(c.arrangement); });
  f.number(Key("smoothing_ratio", "", "Smoothing length over spacing, h / dx.")
               .otherwise("1, but 1.2 with lattice, fitted and disordered"),
           c.smoothing_ratio, between(0.8, 3));
  const bool disordered = c.arrangement == Arrangement::disordered;
  f.number(Key("disorder", "", "Largest random displacement over spacing.")
               .only_if(disordered, "arrangement = \"disordered\""),
           c.disorder, between(0, 0.5));
  f.integer(Key("seed", "", "Seed of the random displacements.")
                .only_if(disordered, "arrangement = \"disordered\""),
            c.seed, between(0, 999999));
}

void declare(Fields& f, SoilCase& c) {
  f.name(Key("name", "", "Name of the soil, unlike any other.").required(), c.name);
  f.polygon(Key("polygon", "m", "Outline, last point not repeated, either orientation.").required(),
            c.polygon);
  f.polygons(Key("holes", "m", "Outlines inside the polygon without soil."), c.holes);
  f.number(Key("youngs_modulus", "Pa", "Drained Young's modulus E.").required(), c.youngs_modulus,
           above(0, stiffest));
  f.number(Key("poissons_ratio", "", "Drained Poisson's ratio.").required(), c.poissons_ratio,
           {.min = -1, .max = 0.5, .min_included = false, .max_included = false});
  f.number(Key("unit_weight_saturated", "N/m3", "Unit weight of the soil below water.").required(),
           c.unit_weight_saturated, above(0, heaviest));
  f.set_defaults([&] { c.unit_weight_unsaturated = c.unit_weight_saturated; });
  f.number(
      Key("unit_weight_unsaturated", "N/m3", "Unit weight of the soil above water; not more than saturated.")
          .otherwise("as saturated"),
      c.unit_weight_unsaturated, above(0, heaviest));
  if (c.unit_weight_unsaturated > c.unit_weight_saturated)
    f.reject("unit_weight_unsaturated",
             fmt::format("must be <= unit_weight_saturated = {} N/m3", c.unit_weight_saturated));
  f.choice(
      Key("law", "",
          "How stress follows strain. `elastic`: linear, without end; the others are so until they yield. "
          "`drucker_prager`: friction and cohesion by a cone that in plane strain has Mohr and Coulomb's "
          "strength; `mohr_coulomb`: theirs itself; `tresca`: undrained clay, whose shear strength does not "
          "depend on pressure."),
      c.law, laws);
  f.flag(
      Key("no_tension", "",
          "A soil without cohesion: no effective stress where its mean would be tensile. Where the mean is "
          "compressive the soil stays elastic and its shear strength is unlimited: nothing slips.")
          .only_if(c.law == LawKind::elastic, "law = \"elastic\""),
      c.no_tension);
  declare_strength(f, c.law, c.strength);
  const double upright = c.permeability.y();
  f.number(Key("permeability", "m/s", "Hydraulic conductivity k of the saturated soil, where water flows.")
               .otherwise("none"),
           c.permeability.x(), above(0, most_permeable));
  f.set_defaults([&] { c.permeability.y() = upright > 0 ? upright : c.permeability.x(); });
  f.number(Key("permeability_vertical", "m/s", "The same along y, in soil that is anisotropic.")
               .only_if(c.permeability.x() > 0, "permeability")
               .otherwise("as permeability"),
           c.permeability.y(), above(0, most_permeable));
  f.number(Key("porosity", "", "Part of the soil that is water, whose volume gives way with it.")
               .only_if(c.permeability.x() > 0, "permeability")
               .otherwise("0.4"),
           c.porosity, {.min = 0, .max = 1, .min_included = false, .max_included = false});
  f.table(Key("retention", "", "How permeability and saturation fall above the water table."), c.retention,
          c.retention.model != RetentionModel::saturated);
  f.point(Key("velocity", "m/s", "Velocity at the start."), c.velocity);
  f.number(Key("angular_velocity", "rad/s",
               "Rotation at the start: counter-clockwise, about the middle of the polygon's bounding box."),
           c.angular_velocity, between(-1e6, 1e6));
  f.number(Key("bending_velocity", "m/s",
               "Vibration at the start: upwards at the right end of a plate that is clamped at its left end, "
               "elsewhere in the shape of the first bending mode. For an upright rectangle."),
           c.bending_velocity, between(-1e6, 1e6));
}

void declare(Fields& f, RetentionCase& c) {
  f.choice(
      Key("model", "",
          "`gardner`: kr = S_e = exp(alpha psi); `van_genuchten`: his S_e with Mualem's kr; `saturated`: "
          "kr falls from 1 at the water table to 0.001 within one spacing above it, and suction does not "
          "act on the soil."),
      c.model, retention_models);
  const bool curved = c.model != RetentionModel::saturated;
  f.number(Key("alpha", "1/m", "Of suction: the larger, the coarser the soil.")
               .only_if(curved, "model = \"gardner\" or \"van_genuchten\""),
           c.alpha, above(0, 1e4));
  const bool genuchten = c.model == RetentionModel::van_genuchten;
  f.number(Key("n", "", "Van Genuchten's n.").only_if(genuchten, "model = \"van_genuchten\""), c.n,
           above(1, 20));
  if (curved && !(c.alpha > 0)) f.reject("alpha", "is missing: the model needs it");
  if (genuchten && !(c.n > 1)) f.reject("n", "is missing: the model needs it");
}

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

static void declare_coupling(Fields& f, bool used, CouplingCase& c) {
  const auto key = [&](std::string_view name, std::string_view unit, std::string_view meaning) {
    return Key(name, unit, meaning).only_if(used, "mode = \"coupled\"");
  };
  bool incompressible = !(c.bulk_modulus < never);
  double modulus = incompressible ? CouplingCase{}.bulk_modulus : c.bulk_modulus;
  f.number_or(key("bulk_modulus", "Pa", "Of water; `incompressible`: it keeps its volume."), modulus,
              above(0, stiffest), "incompressible", incompressible);
  c.bulk_modulus = incompressible ? CouplingCase::incompressible : modulus;
  f.number(key("first_step", "s", "First step of the flow.")
               .otherwise("spacing^2 / c_v, which water takes from one particle to the next"),
           c.first_step, above(0, longest));
  f.number(key("growth", "", "Largest ratio of a flow step to the one before it."), c.growth, between(1, 2));
  f.number(key("tolerance", "",
               "Of the error that a flow step makes in time, over the largest excess pressure; a tenth of it "
               "may be "
               "left of forces and of changes of pressure."),
           c.tolerance, between(1e-6, 0.1));
}

void declare(Fields& f, WaterCase& c) {
  f.choice(
      Key("mode", "",
          "`still`: the water stands under its level; `steady`: it flows steadily between the faces "
          "[[water.face]], and the soil then comes to rest in that flow; `coupled`: saturated soil under a "
          "level gives its water away over time, at rest all the while (consolidation)."),
      c.mode, water_modes);
  f.number(Key("unit_weight", "N/m3", "Unit weight of water."), c.unit_weight, above(0, heaviest));
  const bool still = c.mode == WaterMode::still, levelled = c.mode != WaterMode::steady;
  const bool coupled = c.mode == WaterMode::coupled;
  declare_coupling(f, coupled, c.coupling);
  f.tables(Key("face", "",
               "What holds at a stretch of the outline of the soils where water flows; where faces overlap "
               "the later "
               "one holds. With `steady` the whole outline must be named. With `coupled` nothing passes "
               "boundaries "
               "and the rest drains, where no face says otherwise.")
               .only_if(c.mode != WaterMode::still, "mode = \"steady\" or \"coupled\""),
           c.faces);
  const bool moves = !c.level_over_time.empty();
  double level = level_everywhere(c) && !moves ? c.stretches[0].level : never;
  std::vector<WaterStretch> stretches = level_everywhere(c) ? std::vector<WaterStretch>{} : c.stretches;
  f.number(Key("level", "m", "y of the free surface, the same everywhere.")
               .only_if(levelled, "mode = \"still\" or \"coupled\"")
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

void declare(Fields& f, BoundaryCase& c) {
  f.choice(Key("kind", "", "`roller`: free to slide along it; `fixed`: no motion.").required(), c.kind,
           boundary_kinds);
  f.point(Key("from", "m", "One end.").required(), c.from);
  f.point(Key("to", "m", "The other end.").required(), c.to);
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

void declare(Fields& f, FormulationCase& c) {
  f.choice(
      Key("motion", "",
          "Momentum equation. `conventional`: eq. (17), `proposed`: eq. (24), `rho_squared`: eq. (25) of the "
          "paper; `consistent`: each stress with its own correction matrix."),
      c.motion, motions);
  f.set_defaults([&] { c = default_formulation(c.motion); });
  f.flag(Key("kernel_correction", "", "Gradients exact for linear fields, eqs. (9) and (10)."),
         c.kernel_correction);
  const bool consistent = c.motion == Motion::consistent;
  const auto key = [&](std::string_view name, std::string_view meaning) {
    return Key(name, "", meaning).only_if(!consistent, "motion = one of the paper's forms");
  };
  const FormulationCase paper = default_formulation(Motion::proposed);
  f.number(key("artificial_viscosity_alpha", "Linear term of the viscosity between pairs; 0: off.")
               .otherwise(fmt::to_string(paper.artificial_viscosity_alpha)),
           c.artificial_viscosity_alpha, between(0, 10));
  f.number(key("artificial_viscosity_beta", "Quadratic term of the viscosity between pairs; 0: off."),
           c.artificial_viscosity_beta, between(0, 10));
  f.number(key("artificial_stress", "Strength of the artificial stress against clumping; 0: off.")
               .otherwise(fmt::to_string(paper.artificial_stress)),
           c.artificial_stress, between(0, 1));

  const auto key_of_consistent = [&](std::string_view name, std::string_view meaning) {
    return Key(name, "", meaning).only_if(consistent, "motion = \"consistent\"");
  };
  const FormulationCase usual = default_formulation(Motion::consistent);
  f.number(key_of_consistent("bulk_viscosity", "Viscosity of each particle in compression; 0: off.")
               .otherwise(fmt::to_string(usual.bulk_viscosity)),
           c.bulk_viscosity, between(0, 10));
  f.number(key_of_consistent("zero_energy_control",
                             "Viscosity on the part of the motion that no gradient sees; 0: off.")
               .otherwise(fmt::to_string(usual.zero_energy_control)),
           c.zero_energy_control, between(0, 1));
  f.number(
      key_of_consistent("zero_energy_stiffness",
                        "Elastic part of that control: a spring of this times the control's strength "
                        "times the constrained modulus of the softest soil in reach; 0: viscous only.")
          .otherwise("0.1 where soils of different stiffness meet or outlines cut cells; 0.6 where walls "
                     "turn corners, slits part the soil or gradients had to be closed, 0.1 if it may "
                     "yield; else 0"),
      c.zero_energy_stiffness, between(0, 10));
  f.number(key_of_consistent("refresh_strain",
                             "Strain or rotation after which kernel gradients are rebuilt; 0: every step.")
               .otherwise(fmt::to_string(usual.refresh_strain)),
           c.refresh_strain, between(0, 0.1));
  f.flag(key_of_consistent(
             "closed_gradients",
             "Change the gradients of disordered particles so that a uniform stress is in balance."),
         c.closed_gradients);
  f.flag(key_of_consistent(
             "single_precision",
             "Store kernel gradients in single precision: less memory where particles lie irregularly."),
         c.single_precision);
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
}

void declare(Fields& f, ProbeCase& c) {
  f.name(Key("name", "", "Name of the probe, unlike any other.").required(), c.name);
  f.point(Key("position", "m", "Position at the start; the probe then moves with the soil.").required(),
          c.position);
}

}  // namespace porosph
