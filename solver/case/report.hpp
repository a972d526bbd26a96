// Where a case's values come from and what is wrong with them, for error messages.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

namespace porosph {

/// A value that was set from outside the file.
struct Override {
  std::string key;   ///< full path, as "soil[0].youngs_modulus"
  std::string text;  ///< as it was given
};

/// Errors of one case. Keys are full paths, "soil[0].polygon[2]"; the empty path is the whole case.
class Report {
 public:
  Report(std::string_view file, const toml::table& root, const std::vector<Override>& overrides)
      : file_(file), root_(root), overrides_(overrides) {}

  void add(const std::string& key, std::string_view message);  ///< at the key's value
  void add(const std::string& key, std::string_view message,
           toml::source_position at);  ///< elsewhere in the file
  std::size_t size() const { return errors_.size(); }
  std::string text() const;  ///< in the order of the file, then of the overrides; the first hundred

 private:
  struct Error {
    toml::source_position at;
    std::string text;
  };
  const Override* override_of(const std::string& key) const;
  std::string file_;
  const toml::table& root_;
  const std::vector<Override>& overrides_;
  std::vector<Error> errors_;
};

/// "file:line:column".
std::string place(std::string_view file, toml::source_position at);

/// The word of `known` that was probably meant, or "" if none is near (edit distance).
std::string nearest(std::string_view word, const std::vector<std::string>& known);

}  // namespace porosph
