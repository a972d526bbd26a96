// A small valid case to spoil in tests.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "solver/case/case_file.hpp"

namespace porosph::test {

inline const std::string small_case = R"(title = "Box"

[particles]
spacing = 0.5

[[soil]]
name = "sand"
polygon = [[0, 0], [4, 0], [4, 2], [0, 2]]
youngs_modulus = 1e6
poissons_ratio = 0.3
unit_weight_saturated = 20e3

[[boundary]]
kind = "fixed"
from = [0, 0]
to = [4, 0]

[time]
end = 1
)";

/// The small case with one piece of its text replaced.
inline std::string with(const std::string& old_text, const std::string& new_text) {
  std::string text = small_case;
  const auto at = text.find(old_text);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old_text.size(), new_text);
}

/// What parse_case says of a text; "" if nothing.
inline std::string errors_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_case(text, "box.toml", overrides);
    return "";
  } catch (const CaseError& error) {
    return error.what();
  }
}

/// What parse_case says of the small case with text added after its last line, line 19 being empty.
inline std::string errors_with(const std::string& added, const std::vector<std::string>& overrides = {}) {
  return errors_of(small_case + added, overrides);
}

}  // namespace porosph::test
