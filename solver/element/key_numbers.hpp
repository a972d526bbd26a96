// What a laboratory reads off a test: strength, angles and moduli.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/element/element_test.hpp"

namespace porosph {

struct KeyNumber {
  std::string name;  ///< "undrained shear strength"
  std::string unit;  ///< "Pa", "degrees", "-"
  double value;
};

/// Of a path with at least one step. Moduli are those of the first and the last step; at the peak (s1 - s3)
/// is largest, or |tau| in simple shear. Angles of friction are secants through the origin of Mohr's plane.
std::vector<KeyNumber> key_numbers(const ElementPath& path);

/// Cohesion [Pa] and friction angle [degrees] of the straight line through the peaks of tests that differ in
/// their stress at the start, by least squares of t = s' sin(phi) + c cos(phi) with t = (s1 - s3) / 2 and s'
/// = (s1 + s3) / 2. Empty where the peaks have one s', or no such line has sin(phi) from 0 to 1.
struct Strength {
  double cohesion, friction_angle;
};
std::optional<Strength> strength_of_peaks(const std::vector<const ElementPath*>& paths);

}  // namespace porosph
