#include "solver/run/kept_state.hpp"

#include <cstring>

namespace porosph {
namespace {

class Keeper final : public StateArchive {
 public:
  explicit Keeper(std::vector<std::byte>& kept) : kept_(kept) {}
  bool restoring() const override { return false; }

 private:
  void bytes(std::string_view, void* data, std::size_t size) override {
    const auto* first = static_cast<const std::byte*>(data);
    kept_.insert(kept_.end(), first, first + size);
  }
  std::vector<std::byte>& kept_;
};

class Restorer final : public StateArchive {
 public:
  explicit Restorer(std::span<const std::byte> kept) : rest_(kept) {}
  bool restoring() const override { return true; }
  bool finished() const { return rest_.empty(); }

 private:
  void bytes(std::string_view, void* data, std::size_t size) override {
    if (size > rest_.size()) throw StateError("the kept state is of another case");
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  std::span<const std::byte> rest_;
};

}  // namespace

KeptState::KeptState(Simulation& simulation) {
  Keeper keeper(bytes_);
  simulation.visit(keeper);
}

void KeptState::restore(Simulation& simulation) const {
  Restorer restorer(bytes_);
  simulation.visit(restorer);
  if (!restorer.finished()) throw StateError("the kept state is of another case");
}

}  // namespace porosph
