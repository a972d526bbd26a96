#include "vtk_io/finished_run/stage_scene.hpp"

#include "solver/case/stages.hpp"

namespace porosph {

Case scene_during(const FinishedRun& run, double time) {
  if (run.scene->stages.empty()) return *run.scene;
  StagePlan plan(*run.scene);
  if (run.summary)
    for (const Summary::Stage& stage : run.summary->stages)
      if (!plan.is_last() && time > stage.time) plan.go_on(stage.time);
  return plan.scene();
}

}  // namespace porosph
