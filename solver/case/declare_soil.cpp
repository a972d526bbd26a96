// The keys of a soil: where it is, its law and strength, and what water finds in it.
#include <array>

#include "solver/case/case_file.hpp"
#include "solver/case/fields.hpp"

namespace porosph {
namespace {

using Names = std::string_view;
constexpr std::array<Names, 6> laws{"elastic", "drucker_prager",    "mohr_coulomb",
                                    "tresca",  "modified_cam_clay", "byrne"};
constexpr std::array<Names, 3> softenings{"none", "exponential", "linear"};
constexpr std::array<Names, 2> permeability_laws{"constant", "kozeny_carman"};
constexpr std::array<Names, 4> retention_models{"saturated", "gardner", "van_genuchten", "table"};
constexpr double steepest = 80;  // degrees

/// A key that its soil must have; in the documents as well, where no soil is given.
Key required_if(bool used, std::string_view name, std::string_view unit, std::string_view meaning,
                std::string condition) {
  Key key = Key(name, unit, meaning).only_if(used, std::move(condition)).otherwise("required");
  key.is_required = used;
  return key;
}

void declare_friction(Fields& f, bool used, StrengthCase& c) {
  const std::string condition = "law = \"drucker_prager\", \"mohr_coulomb\" or \"byrne\"";
  f.number(required_if(used, "cohesion", "Pa", "Cohesion c, of effective stress.", condition), c.cohesion,
           between(0, stiffest));
  f.number(
      required_if(used, "friction_angle", "degrees", "Friction angle phi, of effective stress.", condition),
      c.friction_angle, between(0, steepest));
  f.number(
      Key("dilation_angle", "degrees", "Dilation angle psi of plastic flow; not more than friction_angle.")
          .only_if(used, condition),
      c.dilation_angle, between(0, steepest));
  f.number(Key("dilation_limit", "",
               "Volume strain of plastic flow at which dilation ends, as it does in real soil: ln((1 + "
               "e_max) / (1 + e)) "
               "from a void ratio e to the largest one, e_max.")
               .only_if(used && c.dilation_angle > 0, condition + " and dilation_angle > 0"),
           c.dilation_limit, above(0, 10));
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
                  "wide, so plastic strain counts by spacing over this length: results then do not depend "
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
  const bool frictional = has_friction(law);
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

void declare_cam_clay(Fields& f, bool used, CamClayCase& c) {
  const std::string condition = "law = \"modified_cam_clay\"";
  f.number(required_if(used, "critical_state_ratio", "",
                       "M: q over p' at the critical state, 6 sin(phi) / (3 - sin(phi)).", condition),
           c.ratio, above(0, 3));
  f.number(
      required_if(used, "lambda", "", "Slope of the virgin compression line, of e over ln(p').", condition),
      c.lambda, above(0, 10));
  f.number(required_if(used, "kappa", "", "Slope of the swelling lines; less than lambda.", condition),
           c.kappa, above(0, 10));
  if (used && c.kappa >= c.lambda) f.reject("kappa", fmt::format("must be < lambda = {}", c.lambda));
  f.number(required_if(used, "void_ratio", "", "Void ratio e at the start.", condition), c.void_ratio,
           above(0, 100));
  f.number(
      Key("preconsolidation_pressure", "Pa",
          "Mean effective pressure p_c to which the soil has once been compressed; at least what the stress "
          "at the start needs.")
          .only_if(used, condition)
          .otherwise("by overconsolidation_ratio"),
      c.preconsolidation, above(0, stiffest));
  f.number(Key("overconsolidation_ratio", "",
               "p_c over what the K0 stress at the start needs. From no stress, soil needs a "
               "preconsolidation_pressure.")
               .only_if(used && c.preconsolidation == 0, condition + " without preconsolidation_pressure"),
           c.overconsolidation, between(1, 1e4));
  f.number(
      Key("attraction", "Pa",
          "What p' and p_c count from, below zero: it gives soil without stress a stiffness, (1 + e) "
          "attraction / kappa, and a cohesion of attraction times tan(phi). Keep it small beside the stress "
          "that matters.")
          .only_if(used, condition),
      c.attraction, above(0, stiffest));
}

void declare_compaction(Fields& f, bool used, CompactionCase& c) {
  const std::string condition = "law = \"byrne\"";
  f.number(required_if(used, "compaction_c1", "",
                       "C1: volume strain over shear strain by which the first cycle compacts the soil.",
                       condition),
           c.c1, above(0, 100));
  f.number(required_if(used, "compaction_c2", "",
                       "C2: a cycle of the shear strain gamma compacts soil less the more it is compacted "
                       "already, by exp(-C2 e_vd / gamma).",
                       condition),
           c.c2, between(0, 1e4));
  f.number(
      required_if(used, "compaction_threshold", "",
                  "Shear strain that the amplitude of a cycle must exceed to compact the soil.", condition),
      c.threshold, above(0, 1));
}

void declare_pores(Fields& f, SoilCase& c) {
  const double upright = c.permeability.y();
  f.number(Key("permeability", "m/s", "Hydraulic conductivity k of the saturated soil, where water flows.")
               .otherwise("none"),
           c.permeability.x(), above(0, most_permeable));
  f.set_defaults([&] { c.permeability.y() = upright > 0 ? upright : c.permeability.x(); });
  f.number(Key("permeability_vertical", "m/s", "The same along y, in soil that is anisotropic.")
               .only_if(c.permeability.x() > 0, "permeability")
               .otherwise("as permeability"),
           c.permeability.y(), above(0, most_permeable));
  f.choice(
      Key("permeability_law", "",
          "What permeability does as the soil deforms. `constant`: it stays; `kozeny_carman`: it follows the "
          "porosity n as n^3 / (1 - n)^2, from its value at the start, when the porosity is as given."),
      c.permeability_law, permeability_laws);
  f.number(Key("porosity", "",
               "Part of the soil that is pores: what water fills, and what gives way with its volume.")
               .otherwise("0.4"),
           c.porosity, {.min = 0, .max = 1, .min_included = false, .max_included = false});
}

/// At the start.
void declare_motion(Fields& f, SoilCase& c) {
  f.point(Key("velocity", "m/s", "Velocity at the start."), c.velocity);
  f.number(Key("angular_velocity", "rad/s",
               "Rotation at the start: counter-clockwise, about the middle of the polygon's bounding box."),
           c.angular_velocity, between(-1e6, 1e6));
  f.number(Key("bending_velocity", "m/s",
               "Vibration at the start: upwards at the right end of a plate that is clamped at its left end, "
               "elsewhere in the shape of the first bending mode. For an upright rectangle."),
           c.bending_velocity, between(-1e6, 1e6));
}

}  // namespace

std::string_view law_name(LawKind law) { return laws[static_cast<std::size_t>(law)]; }

void declare(Fields& f, SoilCase& c) {
  f.name(Key("name", "", "Name of the soil, unlike any other.").required(), c.name);
  f.polygon(Key("polygon", "m", "Outline, last point not repeated, either orientation.").required(),
            c.polygon);
  f.polygons(Key("holes", "m", "Outlines inside the polygon without soil."), c.holes);
  f.number(
      Key("youngs_modulus", "Pa",
          "Drained Young's modulus E. Of modified Cam-clay, whose stiffness grows with pressure, the most "
          "that it may reach: it sets the time step, and a run ends where the soil becomes stiffer.")
          .required(),
      c.youngs_modulus, above(0, stiffest));
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
          "depend on pressure; `modified_cam_clay`: clay that hardens as it is compressed, with a stiffness "
          "in proportion to its pressure; `byrne`: sand as `mohr_coulomb` has it, which cycles of shear "
          "compact, "
          "so that its water comes under pressure (liquefaction)."),
      c.law, laws);
  f.flag(Key("no_tension", "",
             "A soil without cohesion: no effective stress where its mean would be tensile, and none until "
             "what has "
             "come apart has closed again. Where the mean is compressive the soil stays elastic and its "
             "shear strength "
             "is unlimited: nothing slips.")
             .only_if(c.law == LawKind::elastic, "law = \"elastic\""),
         c.no_tension);
  declare_strength(f, c.law, c.strength);
  declare_cam_clay(f, c.law == LawKind::cam_clay, c.cam_clay);
  declare_compaction(f, c.law == LawKind::byrne, c.compaction);
  declare_pores(f, c);
  declare_motion(f, c);
  f.table(Key("retention", "", "How permeability and saturation fall above the water table."), c.retention,
          c.retention.model != RetentionModel::saturated);
}

void declare(Fields& f, RetentionCase& c) {
  f.choice(
      Key("model", "",
          "`gardner`: kr = S_e = exp(alpha psi); `van_genuchten`: his S_e with Mualem's kr; `saturated`: "
          "kr falls from 1 at the water table to 0.001 within one spacing above it, and suction does not "
          "act on the soil; `table`: S_e and kr at values of suction."),
      c.model, retention_models);
  const bool genuchten = c.model == RetentionModel::van_genuchten, table = c.model == RetentionModel::table;
  const bool curved = c.model == RetentionModel::gardner || genuchten;
  f.number(Key("alpha", "1/m", "Of suction: the larger, the coarser the soil.")
               .only_if(curved, "model = \"gardner\" or \"van_genuchten\""),
           c.alpha, above(0, 1e4));
  f.number(Key("n", "", "Van Genuchten's n.").only_if(genuchten, "model = \"van_genuchten\""), c.n,
           above(1, 20));
  f.pairs(Key("saturation", "m, -",
              "Points of the curve: suction and S_e, from [0, 1] on, linear between and constant beyond.")
              .only_if(table, "model = \"table\"")
              .otherwise("none"),
          c.saturation);
  f.pairs(Key("permeability", "m, -", "The same of kr, whose logarithm is linear between the points.")
              .only_if(table, "model = \"table\"")
              .otherwise("none"),
          c.permeability);
  f.number(
      Key("residual", "", "Water that never leaves, over the volume of the soil: less than its porosity."),
      c.residual, {.min = 0, .max = 1, .max_included = false});
  for (const auto& [name, points] :
       {std::pair("saturation", &c.saturation), {"permeability", &c.permeability}}) {
    if (!table) continue;
    if (points->empty()) {
      f.reject(name, "is missing: the model needs it");
      continue;
    }
    if (points->front() != Point(0, 1)) f.reject(name, "must begin with [0, 1]");
    for (std::size_t i = 1; i < points->size(); ++i)
      if (!((*points)[i].y() > 0 && (*points)[i].y() <= (*points)[i - 1].y()))
        f.reject(name, "must fall from point to point, and stay above 0");
  }
  if (curved && !(c.alpha > 0)) f.reject("alpha", "is missing: the model needs it");
  if (genuchten && !(c.n > 1)) f.reject("n", "is missing: the model needs it");
}

}  // namespace porosph
