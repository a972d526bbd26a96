#include "solver/analysis/section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "solver/analysis/derived_fields.hpp"
#include "solver/boundary/visibility.hpp"
#include "solver/case/shapes.hpp"
#include "solver/geometry/region.hpp"
#include "solver/sph/kernel/linear_weights.hpp"

namespace porosph {
namespace {

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (a + t * along - p).norm();
}

double distance_to_line(const Point& p, const std::vector<Point>& line) {
  double least = never;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    least = std::min(least, distance_to_segment(p, line[i], line[i + 1]));
  return least;
}

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

constexpr int outside = -2;

/// What is at a point of the line.
struct Hit {
  int soil = outside;
  Point start = Point::Zero();
  std::vector<std::size_t> particles;  ///< that it is interpolated from
  bool in_soil() const { return soil != outside; }
};

class Cutter {
 public:
  Cutter(Frame near, const Case* scene, double smoothing_length, double spacing)
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

  /// `slack`: how far from the outline a point still counts as inside [m].
  Hit at(const Point& p, double slack) const {
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

  /// Appends the values at a point in the soil.
  void append(SectionPiece& piece, const Hit& hit, const Point& p, double along, const Point& tangent) const {
    const std::vector<double> weights = weights_at(p, hit.particles);
    if (piece.along.empty()) {
      piece.soil = hit.soil;
      piece.values.step = frame_.step, piece.values.time = frame_.time;
      for (const FrameField& f : frame_.fields)
        piece.values.fields.push_back({f.name, f.components, std::vector<double>{}});
    }
    piece.along.push_back(along);
    piece.tangent.push_back(tangent);
    piece.starts.push_back(hit.start);
    piece.values.points.insert(piece.values.points.end(), {p.x(), p.y(), 0});
    for (std::size_t f = 0; f < frame_.fields.size(); ++f) {
      const auto& from = std::get<std::vector<double>>(frame_.fields[f].values);
      auto& to = std::get<std::vector<double>>(piece.values.fields[f].values);
      const auto width = static_cast<std::size_t>(frame_.fields[f].width());
      for (std::size_t c = 0; c < width; ++c) {
        double sum = 0;
        for (std::size_t k = 0; k < weights.size(); ++k)
          sum += weights[k] * from[hit.particles[k] * width + c];
        to.push_back(sum);
      }
    }
  }

  /// Points this near to an outline may belong to a line along it: displacements have errors of second order.
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

/// One straight stretch of the line.
struct Segment {
  Point from, tangent;
  double begin = 0, length = 0;  ///< distance of `from` along the line, and its own length [m]
  Point at(double s) const { return from + s * tangent; }
};

/// A point of a segment and what is there. `loose`: near an outline along which the line may run.
struct Sample {
  double s = 0;
  Hit hit;
  bool loose = false;
};

std::vector<Sample> samples_of(const Cutter& cutter, const Segment& segment, int intervals) {
  std::vector<Sample> samples;
  std::vector<Hit> rims;
  for (int i = 0; i <= intervals; ++i) {
    const double s = segment.length * i / intervals;
    samples.push_back({s, cutter.at(segment.at(s), 0)});
    rims.push_back(samples.back().hit.in_soil() || cutter.slack() == 0
                       ? Hit{}
                       : cutter.at(segment.at(s), cutter.slack()));
  }
  const auto is_rim = [&](std::size_t i) { return i < rims.size() && rims[i].in_soil(); };
  const auto is_near = [&](std::size_t i) {
    return i >= samples.size() || samples[i].hit.in_soil() || is_rim(i);
  };
  std::vector<std::size_t>
      along_rim;  // a line that only crosses an outline has a single such point, and air behind
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (is_rim(i) && (is_rim(i - 1) || is_rim(i + 1) || (is_near(i - 1) && is_near(i + 1))))
      along_rim.push_back(i);
  for (const std::size_t i : along_rim) samples[i].hit = rims[i], samples[i].loose = true;
  return samples;
}

class PieceBuilder {
 public:
  PieceBuilder(const Cutter& cutter, std::vector<SectionPiece>& pieces) : cutter_(cutter), pieces_(pieces) {}

  void add(const Segment& segment, const std::vector<Sample>& samples) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (i > 0) cross(segment, samples[i - 1], samples[i]);
      put(segment, samples[i].s, samples[i].hit);
    }
  }

 private:
  void put(const Segment& segment, double s, const Hit& hit) {
    if (!hit.in_soil()) {
      open_ = false;
      return;
    }
    if (!open_ || pieces_.back().soil != hit.soil) pieces_.emplace_back();
    open_ = true;
    SectionPiece& piece = pieces_.back();
    const double along = segment.begin + s;
    if (!piece.along.empty() && along <= piece.along.back()) return;  // a corner of the line, met twice
    cutter_.append(piece, hit, segment.at(s), along, segment.tangent);
  }

  /// Finds the boundaries between two neighbouring points by bisection.
  void cross(const Segment& segment, const Sample& a, const Sample& b) {
    constexpr int most_boundaries = 8, halvings = 46;
    const double slack = a.loose || b.loose ? cutter_.slack() : 0;
    Sample left = a;
    for (int n = 0; n < most_boundaries && left.hit.soil != b.hit.soil; ++n) {
      Sample low = left, high = b;
      for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low.s + high.s);
        Hit hit = cutter_.at(segment.at(middle), slack);
        (hit.soil == left.hit.soil ? low : high) = {middle, std::move(hit)};
      }
      put(segment, low.s, low.hit);
      open_ = false;
      put(segment, high.s, high.hit);
      left = high;
    }
  }

  const Cutter& cutter_;
  std::vector<SectionPiece>& pieces_;
  bool open_ = false;
};

std::vector<Segment> segments_of(const std::vector<Point>& line) {
  std::vector<Segment> segments;
  double done = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double length = (line[i + 1] - line[i]).norm();
    if (length == 0) continue;
    segments.push_back({line[i], (line[i + 1] - line[i]) / length, done, length});
    done += length;
  }
  return segments;
}

double spacing_of(const Frame& frame, const Case* scene) {
  if (scene != nullptr) return scene->particles.spacing;
  if (has_field(frame, "Mass") && has_field(frame, "Density")) return std::sqrt(volumes_of(frame).front());
  throw std::runtime_error(
      "a section needs the spacing of the particles: the series has no case.toml beside it, and no Mass and "
      "Density");
}

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

std::vector<SectionPiece> cut(const Frame& frame, const Case* scene, const std::vector<Point>& line,
                              int points, const std::vector<FieldSelection>& fields) {
  const std::vector<Segment> segments = segments_of(line);
  if (segments.empty() || points < 2)
    throw std::invalid_argument("a section needs a line of some length, and two points at least");
  for (const FieldSelection& field : fields)
    if (!can_show(frame, field.name)) values_of(frame, field);  // throws, and says what there is
  const double spacing = spacing_of(frame, scene), h = smoothing_length_of(frame, scene, spacing);
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < frame.points.size() / 3; ++i)
    if (distance_to_line({frame.points[3 * i], frame.points[3 * i + 1]}, line) < 2.1 * h) near.push_back(i);
  if (near.empty()) return {};
  Frame part = part_of(frame, near);
  if (needs_strain(frame, fields))
    if (const auto strain = derived_field(frame, "Strain")) {
      Frame only{.step = 0, .time = 0, .points = frame.points, .fields = {*strain}};
      part.fields.push_back(std::move(part_of(only, near).fields.front()));
    }
  const Cutter cutter(std::move(part), scene, h, spacing);
  const double length = segments.back().begin + segments.back().length;
  std::vector<SectionPiece> pieces;
  PieceBuilder builder(cutter, pieces);
  for (const Segment& segment : segments) {
    const double share = (points - 1) * segment.length / length;
    builder.add(segment, samples_of(cutter, segment, std::max(1, static_cast<int>(std::lround(share)))));
  }
  return pieces;
}

SectionForce force_through(const std::vector<SectionPiece>& pieces, const std::string& stress) {
  SectionForce force;
  for (const SectionPiece& piece : pieces) {
    const auto xx = values_of(piece.values, {stress, "XX"}), yy = values_of(piece.values, {stress, "YY"}),
               xy = values_of(piece.values, {stress, "XY"});
    for (std::size_t i = 0; i + 1 < piece.along.size(); ++i)
      for (const std::size_t k : {i, i + 1}) {
        const double half = 0.5 * (piece.along[i + 1] - piece.along[i]);
        const Point t = piece.tangent[i + 1], n(-t.y(), t.x());
        const Point traction(xx[k] * n.x() + xy[k] * n.y(), xy[k] * n.x() + yy[k] * n.y());
        force.normal += half * traction.dot(n);
        force.shear += half * traction.dot(t);
      }
  }
  return force;
}

}  // namespace porosph
