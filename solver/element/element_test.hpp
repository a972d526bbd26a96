// The tests of a soil laboratory on one point of soil: what its law answers along a path.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "solver/soil/laws.hpp"

namespace porosph {

/// Where stress and strain lead. y is the specimen's axis, x and z are across it; z is out of the plane in
/// the biaxial and the simple shear test. Undrained: at constant volume, total stress held where a drained
/// test holds effective stress.
enum class ElementTest {
  isotropic,               ///< equal strain all around
  oedometer,               ///< axial strain alone
  triaxial_drained,        ///< axial strain, radial stress held
  triaxial_undrained,      ///< the same at constant volume
  extension_drained,       ///< axial extension, radial stress held
  extension_undrained,     ///< the same at constant volume
  biaxial_drained,         ///< axial strain, none along z, stress along x held
  biaxial_undrained,       ///< the same at constant volume
  simple_shear_drained,    ///< shear strain xy, none along x and z, stress along y held
  simple_shear_undrained,  ///< the same at constant volume
};

/// What a user calls a test: "triaxial-drained".
std::string_view name_of(ElementTest test);
std::span<const std::string_view> element_test_names();
/// Throws std::invalid_argument for a name that there is not.
ElementTest element_test_of(std::string_view name);

bool is_undrained(ElementTest test);
bool is_extension(ElementTest test);
bool is_shear(ElementTest test);

/// Compression is positive in what describes and answers a test, as in a laboratory.
struct ElementSetup {
  ElementTest test = ElementTest::triaxial_drained;
  double axial_stress = 0, radial_stress = 0;  ///< effective, at the start [Pa]
  /// Strain to reach, one after the other from the strain before: of the volume in the isotropic test, shear
  /// strain gamma in simple shear, shortening of the axis elsewhere, lengthening in extension. Or the axial
  /// effective stress to reach, in the isotropic and the oedometer test [Pa].
  std::vector<double> targets;
  bool by_stress = false;
  int steps = 1000;           ///< to each target
  Vec2 place = Vec2::Zero();  ///< where the specimen is from, for strength that grows with depth [m]
};

using ElementStress = Symmetric<Axisymmetric>;

/// Tension is positive in the tensors; the engineering strain gamma is 2 strain.xy. Strain is the sum of its
/// increments, so it is logarithmic.
struct ElementState {
  ElementStress stress, strain;  ///< effective [Pa], [-]
  double pore_pressure = 0;      ///< that an undrained specimen has built up [Pa]
  std::vector<double> history;   ///< what the law remembers

  double mean_pressure() const { return -stress.mean(); }        ///< p' [Pa]
  double volume_compression() const { return -strain.trace(); }  ///< [-]
  double largest_shear_stress() const;                           ///< (s1 - s3) / 2 [Pa]
  double largest_mean() const;                                   ///< -(s1 + s3) / 2 [Pa]
  double mobilised_friction() const;  ///< asin of the former over the latter [degrees]; nan in tension
};

struct ElementPath {
  ElementSetup setup;
  std::vector<Field> history;        ///< names the numbers of ElementState::history
  std::vector<ElementState> states;  ///< the start, then one per step

  /// sqrt(3 J2), negative in extension; axial minus radial stress where those two are principal [Pa].
  double deviator(const ElementState& state) const;
  /// What the test drives: volume compression, axial compression or gamma.
  double strain(const ElementState& state) const;
};

/// No strain leads to the stress that a test asks for.
class NoEquilibrium : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Each step solves for the strain increments that the test leaves open, to round-off. Throws NoEquilibrium,
/// and std::invalid_argument for a law of a program outside.
ElementPath run_element_test(const AnyLaw& law, const ElementSetup& setup);

}  // namespace porosph
