#include "render/film.hpp"

#include <fmt/format.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>
#include <stdexcept>

namespace porosph::render {

struct Film::Encoder {
  WebPAnimEncoder* encoder = nullptr;
  WebPConfig config{};
  int width = 0, height = 0;

  Encoder(int w, int h) : width(w), height(h) {
    WebPAnimEncoderOptions options;
    constexpr int effort = 2;  // of 9: larger ones make the file little smaller
    if (!WebPAnimEncoderOptionsInit(&options) || !WebPConfigInit(&config) ||
        !WebPConfigLosslessPreset(&config, effort))
      throw std::runtime_error("render: the version of libwebp does not fit");
    options.anim_params.loop_count = 0;  // for ever
    encoder = WebPAnimEncoderNew(w, h, &options);
    if (encoder == nullptr) throw std::runtime_error(fmt::format("render: no film of {} x {} pixels", w, h));
  }
  ~Encoder() { WebPAnimEncoderDelete(encoder); }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  [[noreturn]] void fail() const {
    throw std::runtime_error(fmt::format("render: film: {}", WebPAnimEncoderGetError(encoder)));
  }
};

Film::Film(double pictures_per_second) : milliseconds_(1000 / pictures_per_second) {}
Film::~Film() = default;

void Film::add(const Pixels& pixels) {
  if (!encoder_) encoder_ = std::make_unique<Encoder>(pixels.width, pixels.height);
  if (pixels.width != encoder_->width || pixels.height != encoder_->height)
    throw std::runtime_error(fmt::format("render: film: a picture of {} x {} pixels after one of {} x {}",
                                         pixels.width, pixels.height, encoder_->width, encoder_->height));
  WebPPicture picture;
  if (!WebPPictureInit(&picture)) throw std::runtime_error("render: the version of libwebp does not fit");
  picture.use_argb = 1;
  picture.width = pixels.width;
  picture.height = pixels.height;
  const int time = static_cast<int>(std::lround(count_++ * milliseconds_));
  const bool done = WebPPictureImportRGB(&picture, pixels.rgb.data(), 3 * pixels.width) &&
                    WebPAnimEncoderAdd(encoder_->encoder, &picture, time, &encoder_->config);
  WebPPictureFree(&picture);
  if (!done) encoder_->fail();
}

std::string Film::finish() {
  if (!encoder_) throw std::runtime_error("render: a film without pictures");
  const int end = static_cast<int>(std::lround(count_ * milliseconds_));
  WebPData data;
  WebPDataInit(&data);
  if (!WebPAnimEncoderAdd(encoder_->encoder, nullptr, end, nullptr) ||
      !WebPAnimEncoderAssemble(encoder_->encoder, &data))
    encoder_->fail();
  std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
  WebPDataClear(&data);
  return bytes;
}

}  // namespace porosph::render
