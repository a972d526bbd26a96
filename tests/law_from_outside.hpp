// Laws of the library in the clothes of one from outside, to compare both ways.
#pragma once

#include <array>
#include <bit>

#include "solver/soil/external_law.hpp"
#include "solver/soil/law.hpp"

namespace porosph {

/// A law of the library, called as one from outside is.
template <SoilLaw Law>
class FromOutside final : public ExternalLaw {
 public:
  explicit FromOutside(const Law& law) : ExternalLaw(law), law_(law) {}

  std::vector<Field> history() const override { return {Law::history.begin(), Law::history.end()}; }
  void step(const SoilTile& tile) const override {
    for (std::int32_t i = 0; i < tile.count; ++i) {
      const Gradient gradient(tile.gradient[0][i], tile.gradient[1][i], tile.gradient[2][i],
                              tile.gradient[3][i]);
      double* s = tile.stress + 4 * i;
      std::array<double, history_size<Law>> remembered;
      for (std::size_t k = 0; k < remembered.size(); ++k) remembered[k] = tile.history[k][i];
      typename Law::History q;
      if constexpr (history_size < Law >> 0) q = std::bit_cast<typename Law::History>(remembered);
      const Stress now = law_.step({s[0], s[1], s[2], s[3]}, gradient, tile.dt, q);
      if constexpr (history_size < Law >> 0) remembered = std::bit_cast<decltype(remembered)>(q);
      for (std::size_t k = 0; k < remembered.size(); ++k) tile.history[k][i] = remembered[k];
      s[0] = now.xx, s[1] = now.yy, s[2] = now.zz, s[3] = now.xy;
    }
  }

 private:
  Law law_;
};

}  // namespace porosph
