#include "vtk_io/run_folder/checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/checksum.hpp"
#include "vtk_io/run_folder/descriptor.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

// The file: magic, version, checksum of all that follows, then two texts, each behind its length: the case
// and the state. A state is a row of items: name and bytes, each behind its length. Numbers stand as in
// memory.

namespace porosph {
namespace fs = std::filesystem;

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are kept as they stand in memory");

constexpr std::string_view magic = "Porosph checkpoint\n";
constexpr std::uint32_t version = 3;
constexpr const char *newest_name = "checkpoint.bin", *previous_name = "checkpoint.previous.bin";

template <class Number>
void put(std::string& out, Number number) {
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void put_text(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint64_t>(text.size()));
  out.append(text);
}

/// False, and nothing taken, if fewer bytes are left.
template <class Number>
bool take(std::string_view& rest, Number& number) {
  if (rest.size() < sizeof number) return false;
  std::memcpy(&number, rest.data(), sizeof number);
  rest.remove_prefix(sizeof number);
  return true;
}

bool take_text(std::string_view& rest, std::string_view& text) {
  std::uint64_t size = 0;
  if (!take(rest, size) || size > rest.size()) return false;
  text = rest.substr(0, size);
  rest.remove_prefix(size);
  return true;
}

std::uint32_t checksum_of(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.value();
}

}  // namespace

void StatePourer::bytes(std::string_view name, void* data, std::size_t size) {
  std::string head;
  put_text(head, name);
  put(head, static_cast<std::uint64_t>(size));
  sink_(head);
  sink_({static_cast<const char*>(data), size});
}

void StateReader::bytes(std::string_view name, void* data, std::size_t size) {
  std::string_view found, content;
  if (!take_text(rest_, found) || !take_text(rest_, content))
    throw StateError(fmt::format("the saved state ends before '{}'", name));
  if (found != name || content.size() != size)
    throw StateError(fmt::format("the saved state has {} bytes of '{}' in the place of {} bytes of '{}'",
                                 content.size(), found, size, name));
  if (size > 0) std::memcpy(data, content.data(), size);
}

void StateReader::finish() const {
  if (!rest_.empty()) throw StateError("the saved state continues after its end");
}

void write_checkpoint(const fs::path& folder, std::string_view case_text, const StateBytes& state) {
  std::uint64_t size = 0;
  state([&](std::string_view part) { size += part.size(); });
  std::string front(magic), middle;
  put_text(middle, case_text);
  put(middle, size);
  Checksum sum;
  sum.add(middle);
  state([&](std::string_view part) { sum.add(part); });
  put(front, version);
  put(front, sum.value());

  const fs::path newest = folder / newest_name;
  replace_file(newest, [&](const fs::path& temporary) {
    Descriptor file(temporary, O_WRONLY | O_CREAT | O_EXCL, newest);
    file.write(front);
    file.write(middle);
    state([&](std::string_view part) { file.write(part); });
    std::error_code error;
    fs::rename(newest, folder / previous_name, error);
    if (error && error != std::errc::no_such_file_or_directory) throw WriteError(newest, error.message());
  });
}

bool has_checkpoint(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / newest_name, ignored) || fs::exists(folder / previous_name, ignored);
}

std::string read_checkpoint(const fs::path& file, std::string_view case_text) {
  const std::string text = read_file(file);
  std::string_view rest = text;
  if (!rest.starts_with(magic)) throw ReadError(file, "it is not a checkpoint");
  rest.remove_prefix(magic.size());
  std::uint32_t its_version = 0, its_checksum = 0;
  if (!take(rest, its_version) || !take(rest, its_checksum)) throw ReadError(file, "it is cut short");
  if (its_version != version)
    throw ReadError(file, fmt::format("its format is {}, this program's is {}", its_version, version));
  if (checksum_of(rest) != its_checksum) throw ReadError(file, "it is damaged: its checksum is not right");
  std::string_view its_case, state;
  if (!take_text(rest, its_case) || !take_text(rest, state) || !rest.empty())
    throw ReadError(file, "it is damaged: its lengths do not fit");
  if (its_case != case_text) throw ReadError(file, "it belongs to another case");
  return std::string(state);
}

std::optional<FoundState> find_state(const fs::path& folder, std::string_view case_text) {
  if (!has_checkpoint(folder)) return std::nullopt;
  const fs::path newest = folder / newest_name, previous = folder / previous_name;
  std::string fault;
  if (fs::exists(newest)) {
    try {
      return FoundState{read_checkpoint(newest, case_text), ""};
    } catch (const ReadError& error) {
      if (!fs::exists(previous)) throw;
      fault = error.what();
    }
  }
  FoundState found{read_checkpoint(previous, case_text), fault};
  std::error_code error;
  fs::rename(previous, newest, error);
  if (error) throw WriteError(newest, error.message());
  return found;
}

void remove_checkpoints(const fs::path& folder) {
  std::error_code ignored;  // one that is left does no harm: it is of the same case, and older
  for (const char* name : {newest_name, previous_name}) fs::remove(folder / name, ignored);
}

void keep_newest_checkpoint(const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(folder / newest_name, ignored)) fs::remove(folder / previous_name, ignored);
}

}  // namespace porosph
