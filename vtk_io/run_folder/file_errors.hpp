// What reading and writing files throws: the file and the reason, in one line.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace porosph {

/// A file could not be written; what was there before is untouched.
struct WriteError : std::runtime_error {
  WriteError(const std::filesystem::path& file, const std::string& reason)
      : std::runtime_error("cannot write " + file.string() + ": " + reason) {}
};

/// A file could not be read, or does not hold what it should.
struct ReadError : std::runtime_error {
  ReadError(const std::filesystem::path& file, const std::string& reason)
      : std::runtime_error("cannot read " + file.string() + ": " + reason) {}
  /// The same with more to say.
  ReadError(const ReadError& error, const std::string& more) : std::runtime_error(error.what() + more) {}
};

}  // namespace porosph
