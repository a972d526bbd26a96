#include "render/picture.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <cmath>
#include <cstring>

#include "render/offscreen_window.hpp"
#include "render/vtk_device.hpp"

namespace porosph::render {
namespace {

enum Layer { background, fields, on_top, layer_count };
constexpr int supersampling = 2;

class PaintItem : public vtkContextItem {
 public:
  static PaintItem* New();
  PaintItem(const PaintItem&) = delete;
  PaintItem& operator=(const PaintItem&) = delete;

  std::function<void(Canvas&)> paint;
  bool Paint(vtkContext2D* context) override {
    VtkDevice device(*context, supersampling);
    Canvas canvas(device);
    paint(canvas);
    return true;
  }

 protected:
  PaintItem() = default;
  ~PaintItem() override = default;
};
vtkStandardNewMacro(PaintItem);

vtkSmartPointer<vtkActor> actor_of(const Patches& patches) {
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(patches.corners.size()));
  for (std::size_t i = 0; i < patches.corners.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), patches.corners[i].x, patches.corners[i].y, 0);
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(static_cast<vtkIdType>(patches.size()));
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const std::size_t begin = i == 0 ? 0 : patches.ends[i - 1];
    cells->InsertNextCell(static_cast<int>(patches.ends[i] - begin));
    for (std::size_t k = begin; k < patches.ends[i]; ++k) cells->InsertCellPoint(static_cast<vtkIdType>(k));
    colours->SetTypedTuple(static_cast<vtkIdType>(i), patches.colours[i].data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  patches.dot > 0 ? data->SetVerts(cells) : data->SetPolys(cells);
  if (patches.dot > 0)
    data->GetPointData()->SetScalars(colours);
  else
    data->GetCellData()->SetScalars(colours);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  if (patches.dot > 0)
    actor->GetProperty()->SetPointSize(static_cast<float>(std::ceil(patches.dot * supersampling)));
  return actor;
}

void add_patches(vtkRenderWindow& window, const Patches& patches, const Drawing& drawing) {
  const Box& area = patches.area;
  vtkNew<vtkRenderer> renderer;
  renderer->SetLayer(fields);
  renderer->SetViewport(area.x / drawing.width, area.y / drawing.height, area.right() / drawing.width,
                        area.top() / drawing.height);
  renderer->AddViewProp(actor_of(patches));
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.5 * area.height);
  camera->SetFocalPoint(0.5 * area.width, 0.5 * area.height, 0);
  camera->SetPosition(0.5 * area.width, 0.5 * area.height, 10);
  camera->SetClippingRange(1, 20);
  window.AddRenderer(renderer);
}

vtkSmartPointer<vtkRenderWindow> window_of(const Drawing& drawing) {
  auto window = make_offscreen_window(drawing.width * supersampling, drawing.height * supersampling);
  window->SetNumberOfLayers(layer_count);
  vtkNew<vtkRenderer> paper;
  paper->SetBackground(1, 1, 1);
  paper->SetLayer(background);
  window->AddRenderer(paper);
  for (const FieldLayer& layer : drawing.layers) add_patches(*window, layer.patches, drawing);
  vtkNew<PaintItem> item;
  item->paint = drawing.paint;
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(item);
  vtkNew<vtkRenderer> renderer;
  renderer->SetLayer(on_top);
  renderer->AddActor(actor);
  window->AddRenderer(renderer);
  return window;
}

/// The window's pixels, averaged.
vtkSmartPointer<vtkImageShrink3D> image_of(vtkRenderWindow& window) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(&window);
  image->ReadFrontBufferOff();
  auto shrunk = vtkSmartPointer<vtkImageShrink3D>::New();
  shrunk->SetInputConnection(image->GetOutputPort());
  shrunk->SetShrinkFactors(supersampling, supersampling, 1);
  shrunk->MeanOn();
  return shrunk;
}

}  // namespace

std::string png_of(const Drawing& drawing) {
  const auto window = window_of(drawing);
  const auto image = image_of(*window);
  vtkNew<vtkPNGWriter> png;
  png->SetInputConnection(image->GetOutputPort());
  png->WriteToMemoryOn();
  png->Write();
  vtkUnsignedCharArray* bytes = png->GetResult();
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)),
          static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

Pixels pixels_of(const Drawing& drawing) {
  const auto window = window_of(drawing);
  const auto image = image_of(*window);
  image->Update();
  Pixels pixels{drawing.width, drawing.height, {}};
  const auto row = static_cast<std::size_t>(3 * drawing.width);
  pixels.rgb.resize(row * static_cast<std::size_t>(drawing.height));
  for (int y = 0; y < drawing.height; ++y)
    std::memcpy(pixels.rgb.data() + static_cast<std::size_t>(drawing.height - 1 - y) * row,
                image->GetOutput()->GetScalarPointer(0, y, 0), row);
  return pixels;
}

}  // namespace porosph::render
