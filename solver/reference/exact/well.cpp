#include "solver/reference/exact/well.hpp"

#include <cmath>
#include <numbers>

namespace porosph {
namespace {

constexpr double pi = std::numbers::pi;

/// Of a sink at height `well` of a strip from y = 0 to `height` that is endless along x, at (x, y) from x of
/// the sink: images in both sides add up to this.
double drop_in_strip(double x, double y, double well, double height) {
  const double e = std::exp(-pi * std::abs(x) / height);
  const auto part = [&](double dy) { return 1 + e * e - 2 * e * std::cos(pi * dy / height); };
  return 0.5 * std::log(part(y + well) / part(y - well));
}

}  // namespace

WellInRectangle::WellInRectangle(const Vec2& size, const Vec2& well) : size_(size), well_(well) {}

/// Images in the sides x = 0 and x = size, of both signs by turns, fall off as exp(-pi x / height).
template <class OfWell>
double WellInRectangle::with_images(const Vec2& at, OfWell&& of_well) const {
  constexpr int images = 8;
  double sum = 0;
  for (int i = -images; i <= images; ++i) {
    const double shift = 2 * i * size_.x();
    sum += i == 0 ? of_well() : drop_in_strip(at.x() - well_.x() - shift, at.y(), well_.y(), size_.y());
    sum -= drop_in_strip(at.x() + well_.x() - shift, at.y(), well_.y(), size_.y());
  }
  return sum;
}

double WellInRectangle::drop(const Vec2& at) const {
  return with_images(at, [&] { return drop_in_strip(at.x() - well_.x(), at.y(), well_.y(), size_.y()); });
}

double WellInRectangle::reach() const {
  // drop_in_strip -> ln(r0 / r) at the well itself
  const double r0 = 2 * size_.y() / pi * std::sin(pi * well_.y() / size_.y());
  return std::exp(with_images(well_, [&] { return std::log(r0); }));
}

}  // namespace porosph
