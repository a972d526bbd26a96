// A run that continues from a kept state gives the bits of one that was not interrupted: all shipped cases.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "solver/case/stages.hpp"
#include "solver/run/energy_budget.hpp"
#include "solver/run/kept_state.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/stability/scenes.hpp"

using namespace porosph;

namespace {

/// What is saved, by name.
class NamedBytes final : public StateArchive {
 public:
  explicit NamedBytes(Simulation& simulation) { simulation.visit(*this); }
  bool restoring() const override { return false; }

  /// The first entry in which the other differs; empty where it is the same.
  std::string first_difference(const NamedBytes& other) const {
    for (std::size_t i = 0; i < std::max(kept_.size(), other.kept_.size()); ++i) {
      if (i >= kept_.size() || i >= other.kept_.size()) return "number of entries";
      if (kept_[i] != other.kept_[i]) return kept_[i].first;
    }
    return "";
  }

 private:
  void bytes(std::string_view name, void* data, std::size_t size) override {
    const auto* first = static_cast<const std::byte*>(data);
    kept_.emplace_back(name, std::vector<std::byte>(first, first + size));
  }
  std::vector<std::pair<std::string, std::vector<std::byte>>> kept_;
};

std::vector<std::filesystem::path> shipped_runs() {
  const std::filesystem::path root = std::filesystem::path(POROSPH_SOURCE_DIR) / "cases";
  std::vector<std::filesystem::path> all;
  for (const char* folder : {"", "collapse", "failure", "loads", "seepage", "stages", "verification"})
    for (const auto& file : std::filesystem::directory_iterator(root / folder))
      if (file.path().extension() == ".toml") all.push_back(file.path());
  std::ranges::sort(all);
  return all;
}

/// With twice its spacing; the first stage of those that have some.
Case coarser(const std::filesystem::path& file) {
  Case scene = read_case(file);
  const std::string spacing = std::to_string(2 * scene.particles.spacing);
  try {
    return read_case(file, {"particles.spacing=" + spacing});
  } catch (const CaseError&) {
    return scene;  // a detail would be too small
  }
}

/// As outputs do.
void look_at(Simulation& simulation) {
  simulation.accelerations();
  simulation.velocities();
  simulation.unbalanced_force_ratio();
  energy_budget(simulation, 0);
}

}  // namespace

TEST_CASE("shipped cases continue from any moment to the same bits", "[resume]") {
  constexpr std::size_t particle_steps = 400'000;
  Noise noise(3);
  for (const std::filesystem::path& file : shipped_runs()) {
    Case scene = coarser(file);
    if (!scene.stages.empty()) scene = StagePlan(scene).scene();
    Simulation whole(scene);
    const auto steps =
        static_cast<int>(std::clamp<std::size_t>(particle_steps / whole.model().particles.size(), 40, 400));
    const auto moment = [&] { return static_cast<int>((0.5 + 0.5 * noise()) * steps); };
    std::vector<int> moments = {moment(), moment(), moment(), moment()};
    std::vector<KeptState> kept;
    std::ranges::sort(moments);
    for (int step = 0; step < steps && whole.step() < whole.last_step(); ++step) {
      while (kept.size() < moments.size() && moments[kept.size()] <= step) kept.emplace_back(whole);
      whole.advance();
    }
    whole.accelerations();
    const NamedBytes at_end(whole);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      CAPTURE(file.stem().string(), moments[i], steps);
      Simulation resumed(scene);
      kept[i].restore(resumed);
      for (int step = moments[i]; step < steps && resumed.step() < resumed.last_step(); ++step) {
        if (step % 5 == 0) look_at(resumed);  // which changes nothing either
        resumed.advance();
      }
      resumed.accelerations();
      CHECK(NamedBytes(resumed).first_difference(at_end) == "");
    }
  }
}
