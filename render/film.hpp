// Pictures one after the other in a file: animated WebP, without loss.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace porosph::render {

/// Rows from the top, three bytes per pixel.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

class Film {
 public:
  explicit Film(double pictures_per_second);
  ~Film();

  /// Throws std::runtime_error for a picture of another size than the first one, or that cannot be encoded.
  void add(const Pixels& pixels);
  /// The file's contents, which plays again and again. Throws std::runtime_error.
  std::string finish();

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
  double milliseconds_;
  int count_ = 0;
};

}  // namespace porosph::render
