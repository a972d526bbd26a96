#include "solver/motion/soil_views.hpp"

namespace porosph {
namespace {

template <SoilLaw Law>
const void* address(const Law& law) {
  return &law;
}
const void* address(const std::shared_ptr<const ExternalLaw>& law) { return law.get(); }

}  // namespace

SoilView SoilViews::view() {
  history_.clear();
  laws_.clear();
  for (const Soil& soil : model_.soils) {
    std::vector<double*>& fields = history_.emplace_back();
    for (const std::size_t place : soil.history())
      fields.push_back(model_.particles.history[place].values.data());
    const void* law = std::visit([](const auto& l) { return address(l); }, soil.law());
    laws_.push_back({soil.law().index(), law, fields.data(), fields.size()});
  }
  return {ranges_.data(), static_cast<std::int32_t>(ranges_.size()), laws_.data()};
}

}  // namespace porosph
