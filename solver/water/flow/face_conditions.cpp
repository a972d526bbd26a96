#include "solver/water/flow/face_conditions.hpp"

namespace porosph {

FaceConditions::FaceConditions(const HydraulicOutline& outline, const std::vector<HydraulicFaceCase>& faces)
    : open_(outline.patches.size(), 1) {
  for (const HydraulicPatch& patch : outline.patches) {
    Condition c;
    c.height = outline.middle(patch).y();
    if (patch.face >= 0) {
      const HydraulicFaceCase& face = faces[patch.face];
      c.kind = face.kind;
      c.seeps = face.kind == FaceKind::seepage || face.kind == FaceKind::head;
      c.level = face.level;
      c.rate = face.kind == FaceKind::flux ? face.rate : 0;
    }
    of_patch_.push_back(c);
  }
}

}  // namespace porosph
