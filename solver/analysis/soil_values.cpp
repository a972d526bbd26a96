#include "solver/analysis/soil_values.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/analysis/derived_fields.hpp"
#include "solver/boundary/visibility.hpp"
#include "solver/case/shapes.hpp"
#include "solver/geometry/region.hpp"
#include "solver/sph/kernel/linear_weights.hpp"

namespace porosph {
namespace {

/// The frame of some of its particles.
Frame part_of(const Frame& frame, const std::vector<std::size_t>& particles) {
  Frame part{.step = frame.step, .time = frame.time, .points = {}, .fields = {}};
  for (const std::size_t i : particles)
    part.points.insert(part.points.end(), frame.points.begin() + static_cast<long>(3 * i),
                       frame.points.begin() + static_cast<long>(3 * i + 3));
  for (const FrameField& field : frame.fields) {
    const auto width = static_cast<std::size_t>(field.width());
    std::vector<double> values;
    values.reserve(particles.size() * width);
    std::visit(
        [&](const auto& all) {
          for (const std::size_t i : particles)
            for (std::size_t c = 0; c < width; ++c) values.push_back(static_cast<double>(all[i * width + c]));
        },
        field.values);
    part.fields.push_back({field.name, field.components, std::move(values)});
  }
  return part;
}

/// Particles near a line, and who is near a point.
class Neighbourhood {
 public:
  Neighbourhood(std::vector<Point> points, double radius) : points_(std::move(points)), radius_(radius) {
    for (const Point& p : points_) low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
    columns_ = bin(high_.x() - low_.x()) + 1;
    rows_ = bin(high_.y() - low_.y()) + 1;
    bins_.resize(columns_ * rows_);
    for (std::size_t i = 0; i < points_.size(); ++i)
      bins_[bin(points_[i].y() - low_.y()) * columns_ + bin(points_[i].x() - low_.x())].push_back(i);
  }

  std::vector<std::size_t> near(const Point& p) const {
    std::vector<std::size_t> found;
    const auto from = [&](double d) { return bin(std::max(0.0, d - radius_)); };
    const auto to = [&](double d, std::size_t count) {
      return d + radius_ < 0 ? 0 : std::min(count, bin(d + radius_) + 1);
    };
    const double x = p.x() - low_.x(), y = p.y() - low_.y();
    for (std::size_t row = from(y); row < to(y, rows_); ++row)
      for (std::size_t column = from(x); column < to(x, columns_); ++column)
        for (const std::size_t i : bins_[row * columns_ + column])
          if ((points_[i] - p).squaredNorm() < radius_ * radius_) found.push_back(i);
    return found;
  }

 private:
  std::size_t bin(double distance) const { return static_cast<std::size_t>(distance / radius_); }

  std::vector<Point> points_;
  double radius_;
  Point low_ = Point::Constant(never), high_ = Point::Constant(-never);
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::vector<std::size_t>> bins_;
};

double smoothing_length_of(const Frame& frame, const Case* scene, double spacing) {
  if (scene != nullptr) return scene->smoothing_length();
  return has_field(frame, "SmoothingLength") ? values_of(frame, {"SmoothingLength", ""}).front()
                                             : 1.2 * spacing;
}

/// Strains are derivatives over all particles around.
bool needs_strain(const Frame& frame, const std::vector<FieldSelection>& fields) {
  return !has_field(frame, "Strain") && std::ranges::any_of(fields, [&](const FieldSelection& f) {
    return !has_field(frame, f.name) && f.name.ends_with("Strain");
  });
}

}  // namespace

struct SoilValues::Implementation {
 public:
  Implementation(Frame near, const Case* scene, double smoothing_length, double spacing)
      : frame_(std::move(near)), scene_(scene), h_(smoothing_length), spacing_(spacing) {
    for (std::size_t i = 0; i < frame_.points.size(); i += 3)
      particles_.position.push_back({frame_.points[i], frame_.points[i + 1]});
    neighbourhood_.emplace(particles_.position, 2 * h_);
    if (has_field(frame_, "Displacement")) particles_.start = starts_of(frame_);
    knows_outlines_ = scene != nullptr && !particles_.start.empty();
    if (!knows_outlines_) return;
    for (const SoilCase& soil : scene->soils) regions_.emplace_back(soil.polygon, soil.holes);
    if (has_field(frame_, "SoilId")) soils_ = values_of(frame_, {"SoilId", ""});
    visibility_ = Visibility(scene->soils, {}, particles_, 2 * h_, spacing_);
  }

  InSoil at(const Point& p, double slack) const {
    std::vector<std::size_t> near = neighbourhood_->near(p);
    if (near.empty()) return {};
    const auto distance_to = [&](std::size_t i) { return (particles_.position[i] - p).squaredNorm(); };
    const std::size_t nearest = *std::ranges::min_element(near, {}, distance_to);
    const double reach = (knows_outlines_ ? 1 : 0.75) * spacing_;
    if (distance_to(nearest) > reach * reach) return {};
    if (!knows_outlines_) return {-1, start_of(p, near), std::move(near)};
    std::erase_if(near, [&](std::size_t i) { return !sees(nearest, i); });
    const std::vector<std::size_t> of_nearest = of_soil(near, soil_of(nearest));
    const Point start = start_of(p, of_nearest);
    for (std::size_t k = 0; k < regions_.size(); ++k) {
      const bool inside = slack > 0 ? distance(start, scene_->soils[k]) < slack : regions_[k].contains(start);
      if (!inside) continue;
      std::vector<std::size_t> own = of_soil(near, static_cast<int>(k));
      if (own.empty()) continue;
      return {static_cast<int>(k), start, std::move(own)};
    }
    return {};
  }

  Frame no_points() const {
    Frame empty{.step = frame_.step, .time = frame_.time, .points = {}, .fields = {}};
    for (const FrameField& f : frame_.fields)
      empty.fields.push_back({f.name, f.components, std::vector<double>{}});
    return empty;
  }

  void append(Frame& values, const InSoil& hit, const Point& p) const {
    const std::vector<double> weights = weights_at(p, hit.particles);
    values.points.insert(values.points.end(), {p.x(), p.y(), 0});
    for (std::size_t f = 0; f < frame_.fields.size(); ++f) {
      const auto& from = std::get<std::vector<double>>(frame_.fields[f].values);
      auto& to = std::get<std::vector<double>>(values.fields[f].values);
      const auto width = static_cast<std::size_t>(frame_.fields[f].width());
      for (std::size_t c = 0; c < width; ++c) {
        double sum = 0;
        for (std::size_t k = 0; k < weights.size(); ++k)
          sum += weights[k] * from[hit.particles[k] * width + c];
        to.push_back(sum);
      }
    }
  }

  double slack() const { return knows_outlines_ ? 0.02 * spacing_ : 0; }

 private:
  int soil_of(std::size_t i) const { return soils_.empty() ? -1 : static_cast<int>(soils_[i]); }

  std::vector<std::size_t> of_soil(const std::vector<std::size_t>& particles, int soil) const {
    if (soils_.empty()) return particles;
    std::vector<std::size_t> own;
    for (const std::size_t i : particles)
      if (soil_of(i) == soil) own.push_back(i);
    return own;
  }

  bool sees(std::size_t a, std::size_t b) const {
    return visibility_.everywhere() || a == b ||
           visibility_.sees(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), particles_);
  }

  std::vector<double> weights_at(const Point& p, const std::vector<std::size_t>& particles) const {
    std::vector<Point> near;
    for (const std::size_t i : particles) near.push_back(particles_.position[i]);
    return linear_weights(p, near, std::vector<double>(near.size(), 1.0), h_);
  }

  Point start_of(const Point& p, const std::vector<std::size_t>& particles) const {
    if (particles_.start.empty()) return p;
    const std::vector<double> weights = weights_at(p, particles);
    Point displacement = Point::Zero();
    for (std::size_t k = 0; k < weights.size(); ++k)
      displacement += weights[k] * particles_.displacement(particles[k]);
    return p - displacement;
  }

  Frame frame_;
  const Case* scene_;
  double h_, spacing_;
  Particles particles_;  ///< places only
  std::optional<Neighbourhood> neighbourhood_;
  bool knows_outlines_ = false;
  std::vector<Region> regions_;
  std::vector<double> soils_;
  Visibility visibility_;
};

SoilValues::SoilValues(Frame particles, const Case* scene, double smoothing_length, double spacing)
    : impl_(std::make_unique<Implementation>(std::move(particles), scene, smoothing_length, spacing)) {}
SoilValues::~SoilValues() = default;
SoilValues::SoilValues(SoilValues&&) noexcept = default;

InSoil SoilValues::at(const Point& p, double slack) const { return impl_->at(p, slack); }
Frame SoilValues::no_points() const { return impl_->no_points(); }
void SoilValues::append(Frame& values, const InSoil& hit, const Point& p) const {
  impl_->append(values, hit, p);
}
double SoilValues::slack() const { return impl_->slack(); }

std::optional<SoilValues> soil_values(const Frame& frame, const Case* scene,
                                      const std::vector<FieldSelection>& fields,
                                      const std::function<bool(const Point&, double)>& near) {
  for (const FieldSelection& field : fields)
    if (!can_show(frame, field.name)) values_of(frame, field);  // throws, and says what there is
  const double spacing = spacing_of(frame, scene), h = smoothing_length_of(frame, scene, spacing);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < frame.points.size() / 3; ++i)
    if (near({frame.points[3 * i], frame.points[3 * i + 1]}, h)) chosen.push_back(i);
  if (chosen.empty()) return std::nullopt;
  Frame part = part_of(frame, chosen);
  if (needs_strain(frame, fields))
    if (const auto strain = derived_field(frame, "Strain")) {
      Frame only{.step = 0, .time = 0, .points = frame.points, .fields = {*strain}};
      part.fields.push_back(std::move(part_of(only, chosen).fields.front()));
    }
  return SoilValues(std::move(part), scene, h, spacing);
}

double spacing_of(const Frame& frame, const Case* scene) {
  if (scene != nullptr) return scene->particles.spacing;
  if (has_field(frame, "Mass") && has_field(frame, "Density")) return std::sqrt(volumes_of(frame).front());
  throw std::runtime_error(
      "values in the soil need the spacing of the particles: the series has no case.toml beside it, and no "
      "Mass and "
      "Density");
}

}  // namespace porosph
