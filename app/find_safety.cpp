#include "app/find_safety.hpp"

#include <fmt/format.h>

#include "app/interruption.hpp"
#include "app/say.hpp"
#include "app/stopwatch.hpp"
#include "solver/case/safety_obstacle.hpp"
#include "solver/reference/limit_equilibrium/section_of_case.hpp"
#ifdef POROSPH_HAS_VTK
#include "vtk_io/line_vtp.hpp"
#endif
#ifdef POROSPH_HAS_RENDER
#include "render/report/safety_study.hpp"
#include "render/run/safety_pictures.hpp"
#endif

namespace porosph::app {

#ifdef POROSPH_HAS_RENDER
using namespace render;
#endif

namespace {

void find_by_limit_equilibrium(const Case& scene, SafetyAnswer& answer) {
  const Stopwatch watch;
  answer.limit_equilibrium = limit_equilibrium::find_critical_surfaces(limit_equilibrium::section_of(scene));
  answer.limit_equilibrium_seconds = watch.seconds();
}

void find_by_particles(const Case& scene, const SafetyRequest& request, SafetyAnswer& answer) {
  StrengthReductionOptions options{
      .bracket = request.bracket, .jobs = request.jobs, .from = request.from, .interrupted = is_interrupted};
  if (answer.limit_equilibrium) {
    options.first_guess = answer.limit_equilibrium->bishop.factor;
    if (answer.limit_equilibrium->general) options.lower_guess = answer.limit_equilibrium->general->factor;
  }
  if (!request.quiet)
    options.finished = [](const StrengthTrial& t) {
      say(stdout, fmt::format("strength / {:<7.4f} {}, {:.4g} m after {} steps\n", t.factor, words_of(t.end),
                              t.displacement, t.steps));
    };
  const Stopwatch watch;
  answer.particles = reduce_strength(scene, options);
  answer.particle_seconds = watch.seconds();
}

}  // namespace

SafetyAnswer find_safety(const Case& scene, const SafetyRequest& request) {
  SafetyAnswer answer;
  answer.title = scene.title;
  if (!scene.water.flows()) find_by_limit_equilibrium(scene, answer);
  if (request.by_particles) find_by_particles(scene, request, answer);
  if (!request.by_limit_equilibrium) answer.limit_equilibrium.reset();
  if (const std::string apart = disagreement(answer); !apart.empty()) answer.warnings.push_back(apart);
  return answer;
}

void write_safety([[maybe_unused]] const Case& scene, const SafetyAnswer& answer,
                  [[maybe_unused]] const std::string& command, const std::filesystem::path& folder) {
  if (answer.particles) write_trials(folder / "safety.csv", *answer.particles);
  if (answer.limit_equilibrium) {
    write_slip_surfaces(folder / "slip_surfaces.csv", answer);
#ifdef POROSPH_HAS_VTK
    std::vector<std::vector<Point>> lines;
    std::vector<double> factors;
    for (const NamedSurface& s : slip_surfaces(answer))
      lines.push_back(s.surface.points), factors.push_back(s.surface.factor);
    write_lines_vtp(folder / "slip_surfaces.vtp", lines, "FactorOfSafety", factors);
#endif
  }
#ifdef POROSPH_HAS_RENDER
  if (answer.particles) save_safety_curve(answer, folder / "safety.png");
  save_mechanism(scene, answer, folder / "mechanism.png");
  write_study(safety_study(answer, command), folder);
#endif
  write_safety_summary(folder / "safety.json", answer);
}

void write_curve(const SafetyCurve& curve, const std::filesystem::path& folder) {
  write_safety_curve(folder / "curve.csv", curve);
#ifdef POROSPH_HAS_RENDER
  save_safety_over_setting(curve, folder / "curve.png");
#endif
}

std::string tell(const SafetyAnswer& answer) {
  std::string text;
  const auto row = [&](const std::string& method, const std::string& factor, double seconds) {
    text += fmt::format("  {:36} {:18} {:.2f} s\n", method, factor, seconds);
  };
  if (answer.particles)
    row("strength reduction, particles", bracket_text(*answer.particles), answer.particle_seconds);
  for (const NamedSurface& s : slip_surfaces(answer))
    row("limit equilibrium, " + s.name, fmt::format("{:.3f}", s.surface.factor),
        answer.limit_equilibrium_seconds);
  if (answer.limit_equilibrium && !answer.limit_equilibrium->spencer)
    text += "  Spencer's method has no solution: steep soil would hang on its crest in tension\n";
  return text;
}

}  // namespace porosph::app
