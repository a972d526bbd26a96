#include "render/picture.hpp"

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPNGWriter.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <stdexcept>
#include <utility>

#include "render/offscreen_window.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph {

namespace {

enum Layer { background, scenes, drawing, layer_count };

class PaintItem : public vtkContextItem {
 public:
  static PaintItem* New();
  PaintItem(const PaintItem&) = delete;
  PaintItem& operator=(const PaintItem&) = delete;

  std::function<void(Canvas&)> paint;
  bool Paint(vtkContext2D* context) override {
    Canvas canvas(*context, Picture::supersampling);
    paint(canvas);
    return true;
  }

 protected:
  PaintItem() = default;
  ~PaintItem() override = default;
};
vtkStandardNewMacro(PaintItem);

void check_size(int width, int height) {
  constexpr int largest = 8000;
  if (width < 1 || height < 1 || width > largest || height > largest)
    throw std::runtime_error(fmt::format(
        "render: a picture of {} x {} pixels cannot be drawn; allowed are 1 to {}", width, height, largest));
}

}  // namespace

Picture::Picture(int width, int height) : width_(width), height_(height) {
  check_size(width, height);
  window_ = make_offscreen_window(width * supersampling, height * supersampling);
  window_->SetNumberOfLayers(layer_count);
  vtkNew<vtkRenderer> paper;
  paper->SetBackground(1, 1, 1);
  paper->SetLayer(background);
  window_->AddRenderer(paper);
}

void Picture::add_scene(const Box& area, vtkProp* prop) {
  vtkNew<vtkRenderer> renderer;
  renderer->SetLayer(scenes);
  renderer->SetViewport(area.x / width_, area.y / height_, area.right() / width_, area.top() / height_);
  renderer->AddViewProp(prop);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.5 * area.height);
  camera->SetFocalPoint(0.5 * area.width, 0.5 * area.height, 0);
  camera->SetPosition(0.5 * area.width, 0.5 * area.height, 10);
  camera->SetClippingRange(1, 20);
  window_->AddRenderer(renderer);
}

void Picture::draw(std::function<void(Canvas&)> paint) {
  vtkNew<PaintItem> item;
  item->paint = std::move(paint);
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(item);
  vtkNew<vtkRenderer> renderer;
  renderer->SetLayer(drawing);
  renderer->AddActor(actor);
  window_->AddRenderer(renderer);
}

void Picture::save(const std::filesystem::path& path) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window_);
  image->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> shrunk;
  shrunk->SetInputConnection(image->GetOutputPort());
  shrunk->SetShrinkFactors(supersampling, supersampling, 1);
  shrunk->MeanOn();
  vtkNew<vtkPNGWriter> png;
  png->SetInputConnection(shrunk->GetOutputPort());
  png->WriteToMemoryOn();
  png->Write();

  vtkUnsignedCharArray* bytes = png->GetResult();
  write_file(path, {reinterpret_cast<const char*>(bytes->GetPointer(0)),
                    static_cast<std::size_t>(bytes->GetNumberOfValues())});
}

}  // namespace porosph
