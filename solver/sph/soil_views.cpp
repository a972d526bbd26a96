#include "solver/sph/soil_views.hpp"

namespace porosph {
namespace {

template <SoilLaw Law>
const void* address(const Law& law) {
  return &law;
}
const void* address(const std::shared_ptr<const ExternalLaw>& law) { return law.get(); }

}  // namespace

void SoilViews::set_own_sides(std::span<const std::int32_t> place) {
  const std::vector<std::int32_t>& soil = model_.particles.soil;
  ranges_.clear();
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(soil.size()); ++i) {
    const std::int32_t side = place.empty() ? -1 : place[i];
    const bool continues =
        !ranges_.empty() && ranges_.back().soil == soil[i] && (ranges_.back().own_side < 0) == (side < 0);
    if (!continues) ranges_.push_back({i, i, soil[i], side});
    ranges_.back().last = i + 1;
  }
}

SoilView SoilViews::view() {
  history_.clear();
  laws_.clear();
  for (const Soil& soil : model_.soils) {
    std::vector<double*>& fields = history_.emplace_back();
    for (const std::size_t place : soil.history())
      fields.push_back(model_.particles.history[place].values.data());
    const void* law = std::visit([](const auto& l) { return address(l); }, soil.law());
    laws_.push_back({soil.law().index(), law, fields.data(), fields.size(), soil.may_yield()});
  }
  return {ranges_.data(), static_cast<std::int32_t>(ranges_.size()), laws_.data()};
}

}  // namespace porosph
