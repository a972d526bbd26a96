#include "solver/analysis/section.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "solver/analysis/soil_values.hpp"

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

/// One straight stretch of the line.
struct Segment {
  Point from, tangent;
  double begin = 0, length = 0;  ///< distance of `from` along the line, and its own length [m]
  Point at(double s) const { return from + s * tangent; }
};

/// A point of a segment and what is there. `loose`: near an outline along which the line may run.
struct Sample {
  double s = 0;
  InSoil hit;
  bool loose = false;
};

std::vector<Sample> samples_of(const SoilValues& values, const Segment& segment, int intervals) {
  std::vector<Sample> samples;
  std::vector<InSoil> rims;
  for (int i = 0; i <= intervals; ++i) {
    const double s = segment.length * i / intervals;
    samples.push_back({s, values.at(segment.at(s), 0)});
    rims.push_back(samples.back().hit.in_soil() || values.slack() == 0
                       ? InSoil{}
                       : values.at(segment.at(s), values.slack()));
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
  PieceBuilder(const SoilValues& values, std::vector<SectionPiece>& pieces)
      : values_(values), pieces_(pieces) {}

  void add(const Segment& segment, const std::vector<Sample>& samples) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (i > 0) cross(segment, samples[i - 1], samples[i]);
      put(segment, samples[i].s, samples[i].hit);
    }
  }

 private:
  void put(const Segment& segment, double s, const InSoil& hit) {
    if (!hit.in_soil()) {
      open_ = false;
      return;
    }
    if (!open_ || pieces_.back().soil != hit.soil) pieces_.emplace_back();
    open_ = true;
    SectionPiece& piece = pieces_.back();
    const double along = segment.begin + s;
    if (!piece.along.empty() && along <= piece.along.back()) return;  // a corner of the line, met twice
    if (piece.along.empty()) {
      piece.soil = hit.soil;
      piece.values = values_.no_points();
    }
    piece.along.push_back(along);
    piece.tangent.push_back(segment.tangent);
    piece.starts.push_back(hit.start);
    values_.append(piece.values, hit, segment.at(s));
  }

  /// Finds the boundaries between two neighbouring points by bisection.
  void cross(const Segment& segment, const Sample& a, const Sample& b) {
    constexpr int most_boundaries = 8, halvings = 46;
    const double slack = a.loose || b.loose ? values_.slack() : 0;
    Sample left = a;
    for (int n = 0; n < most_boundaries && left.hit.soil != b.hit.soil; ++n) {
      Sample low = left, high = b;
      for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low.s + high.s);
        InSoil hit = values_.at(segment.at(middle), slack);
        (hit.soil == left.hit.soil ? low : high) = {middle, std::move(hit)};
      }
      put(segment, low.s, low.hit);
      open_ = false;
      put(segment, high.s, high.hit);
      left = high;
    }
  }

  const SoilValues& values_;
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

}  // namespace

std::vector<SectionPiece> cut(const Frame& frame, const Case* scene, const std::vector<Point>& line,
                              int points, const std::vector<FieldSelection>& fields) {
  const std::vector<Segment> segments = segments_of(line);
  if (segments.empty() || points < 2)
    throw std::invalid_argument("a section needs a line of some length, and two points at least");
  const auto values = soil_values(
      frame, scene, fields, [&](const Point& p, double h) { return distance_to_line(p, line) < 2.1 * h; });
  if (!values) return {};
  const double length = segments.back().begin + segments.back().length;
  std::vector<SectionPiece> pieces;
  PieceBuilder builder(*values, pieces);
  for (const Segment& segment : segments) {
    const double share = (points - 1) * segment.length / length;
    builder.add(segment, samples_of(*values, segment, std::max(1, static_cast<int>(std::lround(share)))));
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

double flow_through(const std::vector<SectionPiece>& pieces) {
  double flow = 0;
  for (const SectionPiece& piece : pieces) {
    const auto x = values_of(piece.values, {"DarcyVelocity", "X"}),
               y = values_of(piece.values, {"DarcyVelocity", "Y"});
    for (std::size_t i = 0; i + 1 < piece.along.size(); ++i)
      for (const std::size_t k : {i, i + 1}) {
        const Point t = piece.tangent[i + 1], n(-t.y(), t.x());
        flow += 0.5 * (piece.along[i + 1] - piece.along[i]) * Point(x[k], y[k]).dot(n);
      }
  }
  return flow;
}

}  // namespace porosph
