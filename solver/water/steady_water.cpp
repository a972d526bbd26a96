#include "solver/water/steady_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "solver/water/flow/face_switch.hpp"
#include "solver/water/flow/steady_seepage.hpp"

namespace porosph {

SteadyWater::SteadyWater(const Case& scene, const Particles& p, const Vec2& origin)
    : FlowingWater(scene, p, origin) {
  FaceConditions faces(outline_, faces_);
  if (scene.flow) {
    faces.set_time(scene.flow->time);
    FaceSwitch(flow_, faces.size(), 1).update(scene.flow->head, faces);
    record_.through_faces = through_faces(scene.flow->head, faces);
    tell(scene.flow->head, faces);
    return;
  }
  if (const std::int32_t a = flow_.unreached(faces); a >= 0)
    throw std::runtime_error(
        fmt::format("steady seepage: the soil around {} is reached by no [[water.face]] of kind "
                    "\"head\" or \"seepage\"",
                    place(a)));
  std::vector<double> height;
  for (const Vec2& x : p.position) height.push_back(x.y());
  SteadySeepage found = solve_steady(flow_, faces, start_of_steady(faces_, height));
  record_.through_faces = through_faces(found.head, found.faces);
  double in = 0, net = 0;
  for (const double q : record_.through_faces) in += std::max(q, 0.0), net += q;
  record_.imbalance = in > 0 ? net / in : 0;
  record_.newton_steps = found.newton_steps, record_.krylov_iterations = found.krylov_iterations;
  tell(std::move(found.head), found.faces);
}

}  // namespace porosph
