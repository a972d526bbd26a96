#include "app/let_fail.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/command.hpp"
#include "solver/boundary/traction.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/shapes.hpp"
#include "solver/water/standing_water.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::app {
namespace {

namespace fs = std::filesystem;

constexpr double falls = 20;   // duration of the failure, in times of sqrt(H / g)
constexpr double lengths = 6;  // by which floors are extended, in times of H
constexpr int frames = 40;

double height(const Case& scene) {
  double low = never, high = -never;
  for (const SoilCase& soil : scene.soils)
    for (const Point& p : soil.polygon) low = std::min(low, p.y()), high = std::max(high, p.y());
  return high - low;
}

/// Ground on which soil runs out: floors continue where they end without a wall.
void extend_floors(Case& c) {
  const double way = lengths * height(c), near = 1e-6 * c.particles.spacing;
  for (BoundaryCase& floor : c.boundaries) {
    const Vec2 along = (floor.to - floor.from).normalized();
    if (std::abs(along.y()) > 0.5) continue;
    const auto ends_free = [&](const Point& end) {
      return std::ranges::none_of(c.boundaries, [&](const BoundaryCase& other) {
        return &other != &floor && distance(end, end, other.from, other.to) < near;
      });
    };
    const bool from_is_free = ends_free(floor.from), to_is_free = ends_free(floor.to);
    if (from_is_free) floor.from -= way * along;
    if (to_is_free) floor.to += way * along;
  }
}

/// As it stands at its end, watched by nothing.
Case standing(const Case& scene, double factor) {
  Case c = weakened(scene, factor);
  c.water = at_rest_from(c.water, scene.time.end);
  for (LoadCase& load : c.loads) load = at_rest_from(load, scene.time.end);
  for (FootingCase& footing : c.footings) footing = at_rest_from(footing, scene.time.end);
  c.loading.damping = 0, c.loading.damping_until = never;
  c.reference = Reference::none, c.check = {};
  c.stop = {.unbalanced_force_ratio = 0, .on_separation = false};
  c.output.times.clear();
  extend_floors(c);
  return c;
}

Case at_rest(const Case& scene, double factor) {
  Case c = standing(scene, factor);
  c.loading.adaptive_damping = true;
  c.stop.unbalanced_force_ratio = 1e-4;
  c.time.end = longest_rest(scene), c.time.step = -1;
  c.output.interval = 0;
  return c;
}

Case failing(const Case& scene, double factor, const fs::path& from) {
  Case c = standing(scene, factor);
  c.start_from = from.string();
  c.loading.adaptive_damping = false, c.loading.k0_stress = false;
  c.time.end = falls * std::sqrt(height(scene) / scene.loading.gravity), c.time.step = -1;
  c.output.interval = c.time.end / frames;
  if (std::ranges::find(c.output.fields, "PlasticStrain") == c.output.fields.end())
    c.output.fields.emplace_back("PlasticStrain");
  return c;
}

int run_case(const Case& scene, const fs::path& file, const fs::path& folder, bool quiet) {
  write_file(file, write_case(scene));
  Arguments arguments = {file.string(), "--out", folder.string(), "--force"};
  if (quiet) arguments.emplace_back("--quiet");
  return run_command(arguments);
}

}  // namespace

int let_fail(const Case& scene, const StrengthReduction& found, double factor, const fs::path& folder,
             bool quiet) {
  if (found.fails_at == never || found.stable_at == 0)
    throw UsageError("safety: --then-run needs a factor at which the soil rests and one at which it fails");
  if (factor == 0) factor = found.fails_at;
  if (!(factor >= found.fails_at && factor <= 100))
    throw UsageError(
        fmt::format("--then-run={}: must be from {:.4g}, the smallest factor at which it fails, to 100",
                    factor, found.fails_at));
  const double rests_with = std::min(1.0, found.stable_at);
  int status = run_case(at_rest(scene, rests_with), folder / "rest.toml", folder / "rest", quiet);
  if (status != Exit::done) return status;
  const fs::path runout = folder / "runout";
  status = run_case(failing(scene, factor, folder / "rest"), folder / "runout.toml", runout, quiet);
  if (status != Exit::done) return status;
#ifdef POROSPH_HAS_RENDER
  return render_command(
      {runout.string(), "--field", "PlasticStrain", "--out", (folder / "runout.png").string()});
#else
  return status;
#endif
}

}  // namespace porosph::app
