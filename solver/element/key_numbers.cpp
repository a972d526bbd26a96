#include "solver/element/key_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace porosph {
namespace {

constexpr double degree = std::numbers::pi / 180;

double shear(const ElementPath& path, const ElementState& s) {
  return is_shear(path.setup.test) ? std::abs(s.stress.xy) : s.largest_shear_stress();
}

/// The first state that has all of the peak but round-off: perfectly plastic soil stays there.
const ElementState& peak(const ElementPath& path) {
  double most = 0;
  for (const ElementState& s : path.states) most = std::max(most, shear(path, s));
  return *std::ranges::find_if(path.states,
                               [&](const ElementState& s) { return shear(path, s) >= (1 - 1e-9) * most; });
}

/// Change of the driven stress over that of the driven strain in a step.
template <class Stress>
double modulus(const ElementPath& path, std::size_t step, Stress&& stress) {
  const ElementState &a = path.states[step], &b = path.states[step + 1];
  return (stress(b) - stress(a)) / (path.strain(b) - path.strain(a));
}

struct Numbers {
  std::vector<KeyNumber> list;
  void add(std::string name, std::string unit, double value) {
    if (std::isfinite(value)) list.push_back({std::move(name), std::move(unit), value});
  }
};

template <class Stress>
void add_moduli(Numbers& n, const ElementPath& path, const std::string& name, Stress&& stress) {
  n.add(name + " at the start", "Pa", modulus(path, 0, stress));
  n.add(name + " at the end", "Pa", modulus(path, path.states.size() - 2, stress));
}

/// Secant modulus at half of the largest change of q.
double e50(const ElementPath& path) {
  const double start = path.deviator(path.states.front());
  const double half = 0.5 * (path.deviator(peak(path)) - start);
  for (std::size_t k = 1; k < path.states.size(); ++k) {
    const double q0 = path.deviator(path.states[k - 1]) - start, q1 = path.deviator(path.states[k]) - start;
    if (!(std::abs(q1) >= std::abs(half))) continue;
    const double e0 = path.strain(path.states[k - 1]), e1 = path.strain(path.states[k]);
    return half / (e0 + (half - q0) / (q1 - q0) * (e1 - e0));
  }
  return std::nan("");
}

void add_strength(Numbers& n, const ElementPath& path) {
  const ElementState& s = peak(path);
  const bool shears = is_shear(path.setup.test);
  if (is_undrained(path.setup.test)) n.add("undrained shear strength", "Pa", shear(path, s));
  if (shears)
    n.add("peak shear stress", "Pa", shear(path, s));
  else
    n.add("peak deviator stress q", "Pa", path.deviator(s));
  n.add(shears ? "shear strain at the peak" : "axial strain at the peak", "-", path.strain(s));
  n.add("peak friction angle", "degrees", s.mobilised_friction());
  if (shears)
    n.add("atan(tau / sigma'_yy) at the peak", "degrees", std::atan(shear(path, s) / -s.stress.yy) / degree);
  if (is_undrained(path.setup.test))
    n.add("pore pressure at the peak", "Pa", s.pore_pressure);
  else
    n.add("volume compression at the end", "-", path.states.back().volume_compression());
  if (path.setup.test == ElementTest::simple_shear_undrained)
    n.add("pore pressure at the end over axial stress at the start", "-",
          path.states.back().pore_pressure / path.setup.axial_stress);
}

}  // namespace

std::vector<KeyNumber> key_numbers(const ElementPath& path) {
  Numbers n;
  const auto axial = [](const ElementState& s) { return -s.stress.yy; };
  switch (path.setup.test) {
    case ElementTest::isotropic:
      add_moduli(n, path, "bulk modulus", [](const ElementState& s) { return s.mean_pressure(); });
      n.add("mean effective pressure at the end", "Pa", path.states.back().mean_pressure());
      return n.list;
    case ElementTest::oedometer:
      add_moduli(n, path, "oedometer modulus", axial);
      n.add("radial over axial stress at the end", "-",
            path.states.back().stress.xx / path.states.back().stress.yy);
      n.add("axial effective stress at the end", "Pa", axial(path.states.back()));
      return n.list;
    case ElementTest::simple_shear_drained:
    case ElementTest::simple_shear_undrained:
      n.add("shear modulus at the start", "Pa",
            modulus(path, 0, [](const ElementState& s) { return s.stress.xy; }));
      break;
    default:
      n.add("stiffness dq / d(axial strain) at the start", "Pa",
            modulus(path, 0, [&](const ElementState& s) { return path.deviator(s); }));
      n.add("secant stiffness at half of the peak, E50", "Pa", e50(path));
  }
  add_strength(n, path);
  return n.list;
}

std::optional<Strength> strength_of_peaks(const std::vector<const ElementPath*>& paths) {
  double mean_s = 0, mean_t = 0, ss = 0, st = 0, largest = 0;
  const double count = static_cast<double>(paths.size());
  for (const ElementPath* path : paths) {
    const ElementState& s = peak(*path);
    mean_s += s.largest_mean() / count, mean_t += s.largest_shear_stress() / count;
  }
  for (const ElementPath* path : paths) {
    const ElementState& s = peak(*path);
    const double ds = s.largest_mean() - mean_s, dt = s.largest_shear_stress() - mean_t;
    ss += ds * ds, st += ds * dt, largest = std::max(largest, std::abs(s.largest_mean()));
  }
  if (!(std::sqrt(ss) > 1e-6 * largest)) return std::nullopt;
  double sine = st / ss;
  if (std::abs(sine) < 1e-9) sine = 0;
  if (!(sine >= 0 && sine < 1)) return std::nullopt;
  return Strength{(mean_t - sine * mean_s) / std::sqrt(1 - sine * sine), std::asin(sine) / degree};
}

}  // namespace porosph
