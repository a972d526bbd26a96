#include "solver/run/monitor/zigzag.hpp"

#include <algorithm>
#include <cmath>

#include "solver/space/parallel.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {
namespace {

constexpr double reach = 1.6;                ///< of neighbours, in spacings: eight of them in a lattice
constexpr std::size_t all_around = 7;        ///< neighbours of a particle that is inside
constexpr double flowed = 0.5;               ///< |G| from which neighbours at the start are so no longer
constexpr double of_alternating_rows = 1.5;  ///< what such rows make of their amplitude

/// Displacement from where it was drawn: where fill or a stage counts its own, that jumps between soils [m].
Vec2 moved(const Particles& p, std::size_t a) { return p.position[a] - p.start[a]; }

/// Of the displacement, by least squares over the neighbours; zero where they do not span the plane.
Mat2 gradient(const Particles& p, std::size_t a, std::span<const std::int32_t> near) {
  Mat2 moment = Mat2::Zero(), product = Mat2::Zero();
  for (const std::int32_t b : near) {
    const Vec2 way = p.start[b] - p.start[a];
    moment += way * way.transpose();
    product += (moved(p, b) - moved(p, a)) * way.transpose();
  }
  const double trace = moment.trace();
  if (!(moment.determinant() > 1e-3 * trace * trace)) return Mat2::Zero();
  return product * inverse(moment);
}

/// The largest displacement, spread evenly over the body's length, from neighbour to neighbour [m].
double usual_difference(const Model& model) {
  const Particles& p = model.particles;
  double largest = 0;
  Vec2 low = p.start[0], high = low;
  for (std::size_t a = 0; a < p.size(); ++a) {
    largest = std::max(largest, moved(p, a).squaredNorm());
    low = low.cwiseMin(p.start[a]), high = high.cwiseMax(p.start[a]);
  }
  return std::sqrt(largest) * model.spacing / (high - low).maxCoeff();
}

}  // namespace

Zigzag measure_zigzag(const Model& model) {
  const Particles& p = model.particles;
  const NeighbourList near =
      kept(find_neighbours(p.start, p.size(), reach * model.spacing), [&](std::int32_t a, std::int32_t b) {
        return p.soil[a] == p.soil[b] && model.visibility.sees(a, b, p);
      });
  std::vector<Mat2> gradients(p.size());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) gradients[a] = gradient(p, a, near.of(a));

  std::vector<double> zigzag(p.size(), -1), difference(p.size(), 0);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) {
    const auto list = near.of(a);
    const auto inside = [&](std::size_t b) {
      return near.of(b).size() >= all_around && gradients[b].norm() < flowed;
    };
    if (!inside(a) || !std::all_of(list.begin(), list.end(), inside))
      continue;  // gradients exact for quadratics
    Vec2 foretold = Vec2::Zero();
    for (const std::int32_t b : list) {
      foretold += moved(p, b) - 0.5 * (gradients[a] + gradients[b]) * (p.start[b] - p.start[a]);
      difference[a] += (moved(p, b) - moved(p, a)).squaredNorm();
    }
    const auto count = static_cast<double>(list.size());
    zigzag[a] = (moved(p, a) - foretold / count).norm() / of_alternating_rows;
    difference[a] /= count;
  }

  const auto counts = [&](std::size_t a) { return zigzag[a] >= 0; };
  const double inside = deterministic_sum(p.size(), [&](std::size_t a) { return counts(a) ? 1.0 : 0.0; });
  const double squares =
      deterministic_sum(p.size(), [&](std::size_t a) { return counts(a) ? zigzag[a] * zigzag[a] : 0; });
  const double differences = deterministic_sum(p.size(), [&](std::size_t a) { return difference[a]; });
  Zigzag found;
  if (!(inside > 0 && differences > 0)) return found;
  const double scale = std::max(std::sqrt(differences / inside), usual_difference(model));
  const auto largest = std::max_element(zigzag.begin(), zigzag.end());
  found.largest = *largest;
  found.where = p.start[largest - zigzag.begin()] + model.origin;
  found.rms = std::sqrt(squares / inside) / scale;
  std::erase_if(zigzag, [](double z) { return z < 0; });
  const auto rank =
      zigzag.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(zigzag.size() - 1));
  std::nth_element(zigzag.begin(), rank, zigzag.end());
  found.quantile = *rank / scale;
  return found;
}

}  // namespace porosph
