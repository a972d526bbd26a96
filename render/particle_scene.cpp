#include "render/particle_scene.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

#include "render/picture.hpp"

namespace porosph {

namespace {

/// Coloured cells under construction, in pixels of the plot's box.
struct Cells {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;

  Cells() { colours->SetNumberOfComponents(3); }
  void add_colour(const Colour& colour) { colours->InsertNextTypedTuple(colour.data()); }
  void add_box(const Box& box, const Colour& colour) {
    const vtkIdType first = points->InsertNextPoint(box.x, box.y, 0);
    points->InsertNextPoint(box.right(), box.y, 0);
    points->InsertNextPoint(box.right(), box.top(), 0);
    points->InsertNextPoint(box.x, box.top(), 0);
    cells->InsertNextCell({first, first + 1, first + 2, first + 3});
    add_colour(colour);
  }
  /// `ring`: about `at`, in units of `scale` pixels.
  void add_polygon(Pixel at, const Polygon& ring, Pixel scale, const Colour& colour) {
    cells->InsertNextCell(static_cast<int>(ring.size()));
    for (const Point& corner : ring)
      cells->InsertCellPoint(
          points->InsertNextPoint(at.x + scale.x * corner.x(), at.y + scale.y * corner.y(), 0));
    add_colour(colour);
  }
  void add_point(Pixel at, const Colour& colour) {
    cells->InsertNextCell({points->InsertNextPoint(at.x, at.y, 0)});
    add_colour(colour);
  }
};

bool inside(const Box& box, Pixel at) {
  return at.x >= box.x && at.x <= box.right() && at.y >= box.y && at.y <= box.top();
}

vtkSmartPointer<vtkActor> flat_actor(vtkPolyData* data) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkActor> polygons(const Cells& cells) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(cells.points);
  data->SetPolys(cells.cells);
  data->GetCellData()->SetScalars(cells.colours);
  return flat_actor(data);
}

vtkSmartPointer<vtkActor> gl_points(const Cells& cells, double size) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(cells.points);
  data->SetVerts(cells.cells);
  data->GetPointData()->SetScalars(cells.colours);
  auto actor = flat_actor(data);
  actor->GetProperty()->SetPointSize(static_cast<float>(std::ceil(size * Picture::supersampling)));
  return actor;
}

}  // namespace

vtkSmartPointer<vtkProp> particle_scene(const Plot& plot, const std::vector<Point>& positions,
                                        const std::vector<double>& sizes,
                                        const std::vector<Polygon>& outlines,
                                        const std::vector<Colour>& colours) {
  const bool as_points = positions.size() > most_quads;
  const Pixel per_metre{plot.box.width / (plot.x.high - plot.x.low),
                        plot.box.height / (plot.y.high - plot.y.low)};
  Cells cells;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Pixel at = plot.at(positions[i].x(), positions[i].y());
    if (!inside(plot.box, at)) continue;  // not finite, or so far off that VTK would lose the others' digits
    const Pixel local{at.x - plot.box.x, at.y - plot.box.y};
    if (as_points) {
      cells.add_point(local, colours[i]);
    } else if (!outlines.empty() && !outlines[i].empty()) {
      cells.add_polygon(local, outlines[i], per_metre, colours[i]);
    } else {
      const double side = sizes.size() == 1 ? sizes[0] : sizes[i];
      const double width = per_metre.x * side, height = per_metre.y * side;
      cells.add_box({local.x - 0.5 * width, local.y - 0.5 * height, width, height}, colours[i]);
    }
  }
  if (as_points)
    return gl_points(cells, std::max(per_metre.x, per_metre.y) * *std::ranges::max_element(sizes));
  return polygons(cells);
}

vtkSmartPointer<vtkProp> water_scene(const Plot& plot, const std::vector<WaterStretch>& water, double x_from,
                                     double x_to, double bottom) {
  Cells cells;
  for (const WaterStretch& stretch : water) {
    const Pixel low = plot.at(std::max(stretch.x_from, x_from), bottom);
    const Pixel high = plot.at(std::min(stretch.x_to, x_to), stretch.level);
    if (low.x < high.x && low.y < high.y)
      cells.add_box({low.x - plot.box.x, low.y - plot.box.y, high.x - low.x, high.y - low.y},
                    {222, 236, 250});
  }
  return polygons(cells);
}

}  // namespace porosph
