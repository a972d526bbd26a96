#include "solver/element/element_test.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "solver/soil/mohr_coulomb.hpp"

namespace porosph {
namespace {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

constexpr std::array<std::string_view, 10> names{"isotropic",
                                                 "oedometer",
                                                 "triaxial-drained",
                                                 "triaxial-undrained",
                                                 "extension-drained",
                                                 "extension-undrained",
                                                 "biaxial-drained",
                                                 "biaxial-undrained",
                                                 "simple-shear-drained",
                                                 "simple-shear-undrained"};

enum Component { xx, yy, zz, xy };

Vec4 vector(const ElementStress& s) { return {s.xx, s.yy, s.zz, s.xy}; }
ElementStress tensor(const Vec4& v) { return {v[0], v[1], v[2], v[3]}; }
GradientIn<Axisymmetric> gradient(const Vec4& strain) {
  GradientIn<Axisymmetric> g;
  g.xx = strain[xx], g.yy = strain[yy], g.zz = strain[zz], g.xy = g.yx = strain[xy];
  return g;
}

/// One of the four equations of a step: strain . increment + stress . (stress at its end) = value.
struct Condition {
  Vec4 strain = Vec4::Zero(), stress = Vec4::Zero();
  double value = 0;
};

Condition strain_is(Vec4 weights, double value = 0) { return {weights, Vec4::Zero(), value}; }
Condition stress_is(Vec4 weights, double value) { return {Vec4::Zero(), weights, value}; }

/// A test's conditions; the last one drives it and is given its value step by step.
using Conditions = std::array<Condition, 4>;

/// Tension is positive here: the sign of a driven strain is that of its target.
Conditions conditions_of(const ElementSetup& setup) {
  const Vec4 x = Vec4::Unit(xx), y = Vec4::Unit(yy), z = Vec4::Unit(zz), shear = Vec4::Unit(xy),
             volume = x + y + z;
  const Condition round = strain_is(x - z), upright = strain_is(shear), plane = strain_is(z),
                  same_volume = strain_is(volume), radial = stress_is(x, -setup.radial_stress);
  const Condition drive = setup.by_stress ? stress_is(y, 0) : strain_is(y);
  switch (setup.test) {
    case ElementTest::isotropic:
      return {round, strain_is(x - y), upright, setup.by_stress ? drive : strain_is(volume)};
    case ElementTest::oedometer:
      return {strain_is(x), plane, upright, drive};
    case ElementTest::triaxial_drained:
    case ElementTest::extension_drained:
      return {round, radial, upright, drive};
    case ElementTest::triaxial_undrained:
    case ElementTest::extension_undrained:
      return {round, same_volume, upright, drive};
    case ElementTest::biaxial_drained:
      return {plane, radial, upright, drive};
    case ElementTest::biaxial_undrained:
      return {plane, same_volume, upright, drive};
    case ElementTest::simple_shear_drained:
      return {strain_is(x), plane, stress_is(y, -setup.axial_stress), strain_is(2 * shear)};
    case ElementTest::simple_shear_undrained:
      return {strain_is(x), plane, strain_is(y), strain_is(2 * shear)};
  }
  throw std::invalid_argument("element: no such test");
}

/// +1 where what is driven counts as it is in the tensors.
double sign_of_drive(const ElementSetup& setup) {
  return is_shear(setup.test) || is_extension(setup.test) ? 1 : -1;
}

template <class Law>
struct Specimen {
  const Law& law;
  ElementStress stress;
  typename Law::History history;

  ElementStress after(const Vec4& strain) const {
    typename Law::History copy = history;
    return law.step(stress, gradient(strain), 1, copy);
  }
  void strain_by(const Vec4& strain) { stress = law.step(stress, gradient(strain), 1, history); }
};

Stress in_plane(const ElementSetup& s) { return {-s.radial_stress, -s.axial_stress, -s.radial_stress, 0}; }

/// Newton's method with differences: laws are linear between their kinks or nearly so over a step. Lengths
/// are those of strain: stress is divided by the modulus.
template <class Law>
struct StepSolver {
  const Conditions& conditions;
  double modulus;  ///< of the state before the step [Pa]

  Vec4 residual(const Specimen<Law>& s, const Vec4& strain) const {
    const Vec4 stress = vector(s.after(strain));
    Vec4 r;
    for (int i = 0; i < 4; ++i) {
      const Condition& c = conditions[i];
      r[i] = (c.strain.dot(strain) + c.stress.dot(stress) - c.value) / (c.stress.isZero() ? 1 : modulus);
    }
    return r;
  }
  Mat4 derivative(const Specimen<Law>& s, const Vec4& strain, const Vec4& at, double difference) const {
    Mat4 d;
    for (int j = 0; j < 4; ++j) {
      Vec4 moved = strain;
      moved[j] += difference;
      d.col(j) = (residual(s, moved) - at) / difference;
    }
    return d;
  }

  /// The strain increment from a first guess; false where the equations are not met.
  bool solve(const Specimen<Law>& s, double size, Vec4& strain) const {
    constexpr int most = 60;
    constexpr double enough = 1e-9;  // of the step; what is better than that is taken as well
    const double round_off = 4e-16 * (vector(s.stress).norm() / modulus + size);
    Vec4 r = residual(s, strain);
    for (int k = 0; k < most && r.norm() > round_off; ++k) {
      const Vec4 change = derivative(s, strain, r, 1e-3 * size).fullPivLu().solve(-r);
      double share = 1;
      Vec4 next = strain + change, next_r = residual(s, next);
      while (!(next_r.norm() < r.norm()) && share > 1e-3) {
        share /= 2, next = strain + share * change, next_r = residual(s, next);
      }
      if (!(next_r.norm() < r.norm())) break;
      strain = next, r = next_r;
    }
    return r.allFinite() && r.norm() <= std::max(enough * size, 10 * round_off);
  }
};

template <class Law>
ElementState state_of(const Specimen<Law>& s, const Vec4& strain, const ElementSetup& setup) {
  ElementState state{s.stress, tensor(strain), 0, {}};
  if (is_undrained(setup.test))
    state.pore_pressure =
        is_shear(setup.test) ? setup.axial_stress + s.stress.yy : setup.radial_stress + s.stress.xx;
  state.history.resize(history_size<Law>);
  if constexpr (history_size < Law >> 0)
    std::memcpy(state.history.data(), &s.history, sizeof(double) * history_size<Law>);
  return state;
}

template <class Law>
ElementPath run(const Law& law, const ElementSetup& setup) {
  Conditions conditions = conditions_of(setup);
  Condition& drive = conditions.back();
  const double sign = sign_of_drive(setup);
  Specimen<Law> specimen{law,
                         {-setup.radial_stress, -setup.axial_stress, -setup.radial_stress, 0},
                         history_at_start(law, setup.place, in_plane(setup))};
  ElementPath path{setup, {Law::history.begin(), Law::history.end()}, {}};
  Vec4 strain = Vec4::Zero(), guess = Vec4::Zero();
  path.states.push_back(state_of(specimen, strain, setup));
  double from = setup.by_stress ? setup.axial_stress : 0;
  for (const double target : setup.targets) {
    const double increment = (target - from) / setup.steps;
    guess = Vec4::Zero();
    for (int k = 1; k <= setup.steps; ++k) {
      const StepSolver<Law> solver{conditions, law.constrained_modulus(specimen.stress, specimen.history)};
      const double size = std::abs(increment) / (setup.by_stress ? solver.modulus : 1);
      drive.value = sign * (setup.by_stress ? from + k * increment : increment);
      if (!solver.solve(specimen, size, guess)) {
        guess = Vec4::Zero();
        if (!solver.solve(specimen, size, guess))
          throw NoEquilibrium(
              fmt::format("{}: no strain leads further than step {} of {} towards {:g}: the soil does not "
                          "bear the stress "
                          "that the test holds",
                          name_of(setup.test), k - 1, setup.steps, target));
      }
      specimen.strain_by(guess);
      strain += guess;
      path.states.push_back(state_of(specimen, strain, setup));
    }
    from = target;
  }
  return path;
}

ElementPath run(const std::shared_ptr<const ExternalLaw>&, const ElementSetup&) {
  throw std::invalid_argument("element: the law of a program outside has no element tests");
}

}  // namespace

std::string_view name_of(ElementTest test) { return names[static_cast<std::size_t>(test)]; }

std::span<const std::string_view> element_test_names() { return names; }

ElementTest element_test_of(std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw std::invalid_argument(fmt::format("no test is called '{}'", name));
  return static_cast<ElementTest>(found - names.begin());
}

bool is_undrained(ElementTest t) {
  return t == ElementTest::triaxial_undrained || t == ElementTest::extension_undrained ||
         t == ElementTest::biaxial_undrained || t == ElementTest::simple_shear_undrained;
}

bool is_extension(ElementTest t) {
  return t == ElementTest::extension_drained || t == ElementTest::extension_undrained;
}

bool is_shear(ElementTest t) {
  return t == ElementTest::simple_shear_drained || t == ElementTest::simple_shear_undrained;
}

double ElementState::largest_shear_stress() const { return LargestCircle<Axisymmetric>(stress).radius; }

double ElementState::largest_mean() const { return -LargestCircle<Axisymmetric>(stress).middle; }

double ElementState::mobilised_friction() const {
  const double sine = largest_shear_stress() / largest_mean();
  return sine >= 0 && sine <= 1 ? std::asin(sine) * 180 / std::numbers::pi
                                : std::numeric_limits<double>::quiet_NaN();
}

double ElementPath::deviator(const ElementState& state) const {
  const double root = std::sqrt(1.5 * state.stress.plus_isotropic(-state.stress.mean()).squared());
  const bool negative = !is_shear(setup.test) && state.stress.yy > state.stress.xx;
  return negative ? -root : root;
}

double ElementPath::strain(const ElementState& state) const {
  if (is_shear(setup.test)) return 2 * state.strain.xy;
  if (setup.test == ElementTest::isotropic) return -state.strain.trace();
  return -state.strain.yy;
}

ElementPath run_element_test(const AnyLaw& law, const ElementSetup& setup) {
  return std::visit([&](const auto& l) { return run(l, setup); }, law);
}

}  // namespace porosph
