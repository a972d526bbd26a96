// A sweep: one case, computed over the values of one or two settings.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// A place on an axis: what the map calls it, and the settings ("key=value") that make it.
struct SweepValue {
  std::string label;
  std::vector<std::string> settings;
};

struct SweepAxis {
  std::string title;
  std::vector<SweepValue> values;
};

/// What the vertical effective stress of the final state is compared with.
enum class SweepReference {
  from_case,     ///< the exact solution that the case names
  weight_above,  ///< the weight of soil and water above each particle: level ground and layers
  fem,           ///< finite elements
  energy,        ///< nothing: what numerics took of the energy released stands for the error
};

struct SweepLimits {
  double accurate = 0.02;  ///< largest relative L2 error that is called accurate [-]
  double settled = 1e-3;   ///< largest unbalanced force ratio of a state at rest [-]
};

struct Sweep {
  std::string name;   ///< of its folder
  std::string title;  ///< of the map
  std::filesystem::path case_file;
  std::vector<std::string> settings;  ///< of all its runs
  SweepAxis x, y;                     ///< y may be a single value without settings
  SweepReference reference = SweepReference::from_case;
  SweepLimits limits;
  std::vector<std::string> notes;  ///< what to know when reading the map

  std::size_t size() const { return x.values.size() * y.values.size(); }
  /// Overrides of point i; x runs fastest.
  std::vector<std::string> settings_of(std::size_t i) const;
};

/// The sweep of a TOML file; docs/stability.md describes it. Paths are relative to the file. `quick`: the
/// axes' values under `quick`, where they have some. Throws CaseError naming file, line and key.
Sweep read_sweep(const std::filesystem::path& file, bool quick);

/// "key=v1,v2,...": commas inside brackets, braces and quotes do not separate. Throws CaseError.
SweepAxis parse_axis(const std::string& text);

SweepReference parse_reference(const std::string& name);  ///< throws CaseError

}  // namespace porosph
