// What a run must keep to continue later to the same bits.
#pragma once

#include <span>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <vector>

namespace porosph {

/// A saved state is not one of this case, or was written by another version.
class StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Goes over the numbers of a state, to save them or to restore them: each is declared once for both
/// directions. Arrays are restored into vectors that have their size already, so nothing a file says takes
/// memory.
class StateArchive {
 public:
  virtual ~StateArchive() = default;
  virtual bool restoring() const = 0;

  /// Throws StateError where the state being restored has something else in this place.
  template <class T>
  requires std::is_arithmetic_v<T>
  void value(std::string_view name, T& value) { bytes(name, &value, sizeof value); }
  /// An array of plain numbers: doubles, vectors, tensors. Throws as value().
  template <class T>
  void array(std::string_view name, std::span<T> values) {
    static_assert(std::is_standard_layout_v<T>);
    bytes(name, values.data(), values.size_bytes());
  }
  template <class T>
  void array(std::string_view name, std::vector<T>& values) {
    array(name, std::span<T>(values));
  }

 protected:
  virtual void bytes(std::string_view name, void* data, std::size_t size) = 0;
};

}  // namespace porosph
