#include "solver/boundary/load.hpp"

#include "solver/sph/kernel/linear_weights.hpp"

namespace porosph {
namespace {

struct Ends {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
};

Ends ends_of(const SurfacePiece& piece, const Particles& p) {
  Ends ends;
  for (std::size_t k = 0; k < piece.particles.size(); ++k) {
    ends.from += piece.weight_from[k] * p.position[piece.particles[k]];
    ends.to += piece.weight_to[k] * p.position[piece.particles[k]];
  }
  return ends;
}

}  // namespace

SurfacePiece surface_piece(const Vec2& from, const Vec2& to, std::span<const std::int32_t> near,
                           const Particles& p, double smoothing_length) {
  SurfacePiece piece{.particles = {near.begin(), near.end()}, .weight_from = {}, .weight_to = {}};
  std::vector<Vec2> places;
  std::vector<double> volumes;
  for (const std::int32_t b : near) places.push_back(p.position[b]), volumes.push_back(p.volume(b));
  piece.weight_from = linear_weights(from, places, volumes, smoothing_length);
  piece.weight_to = linear_weights(to, places, volumes, smoothing_length);
  return piece;
}

void add_loads(std::span<const LoadedSurface> surfaces, const Particles& p, double time,
               std::span<Vec2> accelerations) {
  for (const LoadedSurface& surface : surfaces)
    for (const SurfacePiece& piece : surface.pieces) {
      const auto [from, to] = ends_of(piece, p);
      const Vec2 way = to - from;
      const double length = way.norm();
      const Vec2 normal = Vec2(way.y(), -way.x()) / length;
      const Vec2 force = length * surface.load->traction((from + to) / 2, normal, time);
      for (std::size_t k = 0; k < piece.particles.size(); ++k) {
        const std::int32_t b = piece.particles[k];
        accelerations[b] += (piece.weight_from[k] + piece.weight_to[k]) / 2 / p.mass[b] * force;
      }
    }
}

}  // namespace porosph
