#include "solver/reference/limit_equilibrium/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "solver/reference/limit_equilibrium/arc.hpp"
#include "solver/reference/limit_equilibrium/methods.hpp"

namespace porosph::limit_equilibrium {
namespace {

constexpr int coarse_slices = 24, fine_slices = 50, final_slices = 200;
constexpr std::size_t most_ground_points = 36;  // of the first look: pairs of them are tried
constexpr std::size_t few_ground_points = 18;   // where each trial costs more
constexpr std::size_t kept = 6;                 // best of the first look that are improved
constexpr std::size_t bent = 2;                 // surfaces that are bent
constexpr int nodes = 16;                       // of a surface of any shape
constexpr double none = never;                  // factor of a surface that cannot slide

void take_worse(std::optional<CriticalSurface>& worst, CriticalSurface found) {
  if (found.factor < (worst ? worst->factor : none)) worst = std::move(found);
}

/// A line of ground by the distance along it.
class GroundLine {
 public:
  explicit GroundLine(const Polygon& points) : points_(points), distances_{0} {
    for (std::size_t i = 1; i < points.size(); ++i)
      distances_.push_back(distances_.back() + (points[i] - points[i - 1]).norm());
  }
  double length() const { return distances_.back(); }
  Point at(double s) const {
    const auto next = std::upper_bound(distances_.begin() + 1, distances_.end() - 1, s);
    const auto i = static_cast<std::size_t>(next - distances_.begin());
    const double t = (s - distances_[i - 1]) / (distances_[i] - distances_[i - 1]);
    return points_[i - 1] + std::clamp(t, 0.0, 1.0) * (points_[i] - points_[i - 1]);
  }
  /// Distances for a first look: all corners, and closer together beside them than between.
  std::vector<double> samples(std::size_t most) const {
    const std::size_t segments = points_.size() - 1;
    const int each = static_cast<int>(std::clamp<std::size_t>(most / segments, 1, 12));
    std::vector<double> s;
    for (std::size_t i = 0; i < segments; ++i)
      for (int k = 0; k < each; ++k) {
        const double t = 0.5 * (1 - std::cos(k * std::acos(-1) / each));
        s.push_back(distances_[i] + t * (distances_[i + 1] - distances_[i]));
      }
    s.push_back(length());
    return s;
  }

 private:
  Polygon points_;
  std::vector<double> distances_;
};

/// A trial: where it leaves and enters the ground [m], and its depth from 0, the shallowest possible, to 1.
struct Trial {
  double exit, entry, depth;
  double factor = none;
};

/// The least value of a function of some numbers, by steps along each of them that are halved when none helps
/// (Hooke and Jeeves 1961 without their pattern moves).
template <class Numbers, class Value>
double improve(Numbers& x, double value, Numbers step, int halvings, const Value& value_at) {
  for (int level = 0; level < halvings;) {
    bool better = false;
    for (std::size_t i = 0; i < x.size(); ++i)
      for (const double sign : {1.0, -1.0}) {
        Numbers tried = x;
        tried[i] += sign * step[i];
        const double found = value_at(tried);
        if (found >= value * (1 - 1e-7)) continue;
        x = tried, value = found, better = true;
        break;
      }
    if (better) continue;
    ++level;
    for (double& s : step) s *= 0.5;
  }
  return value;
}

/// A section whose slope faces left.
class Search {
 public:
  explicit Search(const Section& section) : section_(section) {
    for (const Polygon& ground : section.grounds()) lines_.emplace_back(ground);
  }

  CriticalSurfaces run() {
    CriticalSurfaces best{{none, {}}, std::nullopt, std::nullopt};
    for (const GroundLine& line : lines_) {
      std::vector<Trial> circles = best_trials(
          line, most_ground_points, [&](const Trial& t) { return bishop_factor(line, t, coarse_slices); });
      for (Trial& trial : circles) {
        polish(trial, 12, [&](const Trial& t) { return bishop_factor(line, t, fine_slices); });
        if (trial.factor < best.bishop.factor) best.bishop = surface_of(line, trial);
      }
      if (circles.empty()) continue;
      guess_ = circles.front().factor;
      const auto starts = spencer_circles(line, circles, best.spencer);
      if (strengths_differ()) bend_best(line, starts, best.general);
    }
    return best;
  }

 private:
  using Factor = std::function<double(const Trial&)>;

  std::optional<Arc> arc_of(const GroundLine& line, const Trial& t, bool keep_floor = true) const {
    if (t.exit < 0 || t.entry > line.length() || t.exit >= t.entry || t.depth < 0 || t.depth > 1)
      return std::nullopt;
    const Point a = line.at(t.exit), b = line.at(t.entry);
    const double least = 1e-6 * line.length();
    if (b.x() - a.x() < least || b.y() - a.y() < least) return std::nullopt;
    const auto spans = possible_spans(section_, a, b, keep_floor);
    if (!spans) return std::nullopt;
    return Arc{a, b, spans->least + t.depth * (spans->most - spans->least)};
  }

  double bishop_factor(const GroundLine& line, const Trial& t, int slices) {
    const auto arc = arc_of(line, t);
    if (!arc) return none;
    cut(section_, arc->points(section_, slices), slices_);
    if (slices_.empty()) return none;
    return bishop(slices_, arc->centre(), arc->radius()).value_or(none);
  }

  double spencer_factor(const SlipSurface& surface) {
    cut(section_, surface, slices_);
    if (slices_.empty()) return none;
    const Point along = surface.back() - surface.front();
    auto found = spencer(slices_, {guess_, 0});
    if (!found) found = spencer(slices_, {guess_, 0.5 * along.y() / along.x()});
    return found ? found->factor : none;
  }

  CriticalSurface surface_of(const GroundLine& line, Trial trial) {
    const SlipSurface points = arc_of(line, trial)->points(section_, final_slices);
    return {bishop_factor(line, trial, final_slices), points};
  }

  static std::vector<Trial> best_trials(const GroundLine& line, std::size_t most_points,
                                        const Factor& factor) {
    std::vector<Trial> best;
    const std::vector<double> s = line.samples(most_points);
    for (std::size_t i = 0; i < s.size(); ++i)
      for (std::size_t j = i + 1; j < s.size(); ++j) {
        Trial least{s[i], s[j], 0};
        for (const double depth : {0.05, 0.3, 0.6, 1.0}) {
          const double found = factor({s[i], s[j], depth});
          if (found < least.factor) least = {s[i], s[j], depth, found};
        }
        if (least.factor < none) best.push_back(least);
      }
    std::sort(best.begin(), best.end(), [](const Trial& a, const Trial& b) { return a.factor < b.factor; });
    // Neighbours of a better one lead to the same place.
    std::vector<Trial> apart;
    for (const Trial& t : best) {
      const auto near = [&](const Trial& o) {
        const double reach = 0.1 * (o.entry - o.exit);
        return std::abs(o.exit - t.exit) < reach && std::abs(o.entry - t.entry) < reach &&
               std::abs(o.depth - t.depth) < 0.3;
      };
      if (std::none_of(apart.begin(), apart.end(), near)) apart.push_back(t);
      if (apart.size() == kept) break;
    }
    return apart;
  }

  static void polish(Trial& t, int halvings, const Factor& factor) {
    std::array<double, 3> x{t.exit, t.entry, t.depth};
    const double step = 0.05 * (t.entry - t.exit);
    const auto value = [&](const std::array<double, 3>& at) { return factor({at[0], at[1], at[2]}); };
    const double found = improve(x, value(x), std::array<double, 3>{step, step, 0.1}, halvings, value);
    t = {x[0], x[1], x[2], found};
  }

  /// The arc, but not below the bottom of a soil.
  SlipSurface cut_off(const Arc& arc, int soil) const {
    SlipSurface surface;
    for (const Point& p : arc.points(section_, coarse_slices)) surface.push_back(p);
    for (std::size_t i = 1; i + 1 < surface.size(); ++i) {
      const auto& column = section_.columns()[section_.column_of(surface[i].x())];
      double bottom = column.floor(surface[i].x());
      for (const Section::Strip& s : column.strips)
        if (s.soil == soil) {
          // Within the layer: along its bottom one would slide on the soil below.
          const double low = column.at(s.bottom, surface[i].x()), high = column.at(s.top, surface[i].x());
          bottom = std::max(bottom, low + 0.02 * (high - low));
        }
      surface[i].y() = std::max(surface[i].y(), bottom);
    }
    return surface;
  }

  /// Improves the worst circles of Bishop's method by Spencer's.
  std::vector<SlipSurface> spencer_circles(const GroundLine& line, const std::vector<Trial>& circles,
                                           std::optional<CriticalSurface>& best) {
    std::vector<SlipSurface> found;
    for (std::size_t i = 0; i < std::min<std::size_t>(circles.size(), 2); ++i) {
      Trial t = circles[i];
      polish(t, 8, [&](const Trial& at) {
        const auto arc = arc_of(line, at);
        return arc ? spencer_factor(arc->points(section_, fine_slices)) : none;
      });
      if (t.factor == none) continue;
      const Arc arc = *arc_of(line, t);
      found.push_back(arc.points(section_, nodes));
      const SlipSurface points = arc.points(section_, final_slices);
      const double factor = spencer_factor(points);
      take_worse(best, {factor, points});
    }
    return found;
  }

  bool strengths_differ() const {
    const auto& soils = section_.soils();
    return std::any_of(soils.begin(), soils.end(),
                       [&](const SectionSoil& soil) { return soil.strength != soils.front().strength; });
  }

  void bend_best(const GroundLine& line, std::vector<SlipSurface> starts,
                 std::optional<CriticalSurface>& best) {
    for (int soil = 0; soil < static_cast<int>(section_.soils().size()); ++soil) {
      if (!section_.soils()[static_cast<std::size_t>(soil)].strength) continue;
      const auto factor = [&](const Trial& at) {
        const auto arc = arc_of(line, at, false);
        return arc ? spencer_factor(cut_off(*arc, soil)) : none;
      };
      std::vector<Trial> trials = best_trials(line, few_ground_points, factor);
      if (trials.empty()) continue;
      polish(trials[0], 8, factor);
      starts.push_back(cut_off(*arc_of(line, trials[0], false), soil));
    }
    std::vector<CriticalSurface> sorted;
    for (SlipSurface& start : starts) sorted.push_back({spencer_factor(start), std::move(start)});
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.factor < b.factor; });
    for (std::size_t i = 0; i < std::min(bent, sorted.size()); ++i) {
      take_worse(best, bend(line, sorted[i].points));
    }
  }

  /// Moves each corner of the surface, and its ends along the ground.
  CriticalSurface bend(const GroundLine& line, SlipSurface surface) {
    surface = resampled(surface);
    // Ends by distance along the ground, then x and y of what is between.
    std::vector<double> x{distance_of(line, surface.front()), distance_of(line, surface.back())};
    for (std::size_t i = 1; i + 1 < surface.size(); ++i)
      x.push_back(surface[i].x()), x.push_back(surface[i].y());
    const auto surface_at = [&](const std::vector<double>& at) {
      SlipSurface s{line.at(at[0])};
      for (std::size_t i = 2; i < at.size(); i += 2) s.push_back({at[i], at[i + 1]});
      s.push_back(line.at(at[1]));
      return s;
    };
    const auto value = [&](const std::vector<double>& at) {
      if (at[0] < 0 || at[1] > line.length()) return none;
      const SlipSurface s = surface_at(at);
      return is_convex(s) ? spencer_factor(s) : none;
    };
    const std::vector<double> step(x.size(), 0.02 * (surface.back() - surface.front()).norm());
    const double factor = improve(x, value(x), step, 7, value);
    return {factor, surface_at(x)};
  }

  static SlipSurface resampled(const SlipSurface& surface) {
    if (surface.size() <= nodes + 1) return surface;
    SlipSurface fewer;
    for (int i = 0; i <= nodes; ++i) fewer.push_back(surface[i * (surface.size() - 1) / nodes]);
    return fewer;
  }

  static double distance_of(const GroundLine& line, const Point& p) {
    double best = 0, nearest = never;
    for (int i = 0; i <= 4000; ++i) {
      const double s = line.length() * i / 4000, d = (line.at(s) - p).squaredNorm();
      if (d < nearest) nearest = d, best = s;
    }
    return best;
  }

  /// Slopes that never fall towards the crest, from not too steep to not too steep.
  static bool is_convex(const SlipSurface& s) {
    constexpr double steepest_exit = -2.75, steepest_entry = 28;  // tan of -70 and 88 degrees
    double before = steepest_exit;
    for (std::size_t i = 1; i < s.size(); ++i) {
      if (s[i].x() <= s[i - 1].x()) return false;
      const double slope = (s[i].y() - s[i - 1].y()) / (s[i].x() - s[i - 1].x());
      if (slope < before - 1e-6) return false;
      before = slope;
    }
    return before <= steepest_entry;
  }

  const Section& section_;
  std::vector<GroundLine> lines_;
  std::vector<Slice> slices_;
  double guess_ = 1;
};

CriticalSurface mirrored(CriticalSurface surface) {
  std::reverse(surface.points.begin(), surface.points.end());
  for (Point& p : surface.points) p.x() = -p.x();
  return surface;
}

}  // namespace

std::optional<CriticalSurfaces> find_critical_surfaces(const Section& section) {
  CriticalSurfaces best = Search(section).run();
  const Section other_way = section.mirrored();
  const CriticalSurfaces other = Search(other_way).run();
  if (other.bishop.factor < best.bishop.factor) best.bishop = mirrored(other.bishop);
  if (other.spencer) take_worse(best.spencer, mirrored(*other.spencer));
  if (other.general) take_worse(best.general, mirrored(*other.general));
  if (best.bishop.factor == none) return std::nullopt;
  return best;
}

}  // namespace porosph::limit_equilibrium
