// checkpoint.bin: the state of a run, from which it continues after an interruption or to a later end.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "solver/particles/state.hpp"

namespace porosph {

/// Takes bytes, one part after the other.
using ByteSink = std::function<void(std::string_view)>;
/// Gives a state's bytes to a sink, the same ones each time that it is called.
using StateBytes = std::function<void(const ByteSink&)>;

/// Hands a state on, item by item: a copy of it would take as much memory as the particles.
class StatePourer : public StateArchive {
 public:
  explicit StatePourer(ByteSink sink) : sink_(std::move(sink)) {}
  bool restoring() const override { return false; }

 private:
  void bytes(std::string_view name, void* data, std::size_t size) override;
  ByteSink sink_;
};

/// Collects a state in memory.
class StateWriter final : public StatePourer {
 public:
  StateWriter() : StatePourer([this](std::string_view part) { content_.append(part); }) {}
  const std::string& content() const { return content_; }

 private:
  std::string content_;
};

/// Gives back a state that StateWriter collected.
class StateReader final : public StateArchive {
 public:
  explicit StateReader(std::string_view content) : rest_(content) {}
  bool restoring() const override { return true; }
  void finish() const;  ///< throws StateError if there is more than was asked for

 private:
  void bytes(std::string_view name, void* data, std::size_t size) override;
  std::string_view rest_;
};

/// Keeps a state in the folder, and the one before it. At every moment one of them is whole. `case_text` is
/// the complete case as write_case gives it, to which the state belongs. Throws WriteError.
void write_checkpoint(const std::filesystem::path& folder, std::string_view case_text,
                      const StateBytes& state);

bool has_checkpoint(const std::filesystem::path& folder);

struct FoundState {
  std::string state;
  std::string note;  ///< why it is not the newest; empty if it is
};

/// The newest state that is whole, if the folder has a checkpoint. One that is damaged, of another case or of
/// another version is passed over, and replaced by the one before it. Throws ReadError where none is left.
std::optional<FoundState> find_state(const std::filesystem::path& folder, std::string_view case_text);

/// The state in one checkpoint. Throws ReadError where it is damaged, of another case or another version.
std::string read_checkpoint(const std::filesystem::path& file, std::string_view case_text);

void remove_checkpoints(const std::filesystem::path& folder);
void keep_newest_checkpoint(const std::filesystem::path& folder);  ///< removes the one before it

}  // namespace porosph
