#include "render/offscreen_window.hpp"

#include <stdexcept>

#if __has_include(<vtkEGLRenderWindow.h>)  // VTK with EGL; from 9.4 on it is loaded when it is used

#include <vtkEGLRenderWindow.h>

namespace porosph::render {
namespace {
using OffscreenWindow = vtkEGLRenderWindow;
}
}  // namespace porosph::render

#elif __has_include(<vtkOSOpenGLRenderWindow.h>)  // VTK with OSMesa

#include <vtkOSOpenGLRenderWindow.h>

namespace porosph::render {
namespace {
using OffscreenWindow = vtkOSOpenGLRenderWindow;
}
}  // namespace porosph::render

#else  // VTK with X: Debian 12

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkObjectFactory.h>
#include <vtk_glew.h>
// after GLEW, which takes this away
#define GLAPI extern
#include <GL/osmesa.h>

// GLEW asks GLX for OpenGL's functions; answering from OSMesa makes it work without X.
extern "C" __attribute__((visibility("default"))) OSMESAproc glXGetProcAddressARB(const unsigned char* name) {
  return OSMesaGetProcAddress(reinterpret_cast<const char*>(name));
}

namespace porosph::render {

namespace {

/// VTK draws into a framebuffer object of its own, so OSMesa's buffer only has to exist.
class OffscreenWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static OffscreenWindow* New();
  using Superclass = vtkGenericOpenGLRenderWindow;
  OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;

  void Initialize() override {
    if (context_) return;
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              24,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0};
    context_ = OSMesaCreateContextAttribs(attributes, nullptr);
    if (!context_) throw std::runtime_error("render: OSMesa gives no OpenGL 3.3 core context");
    MakeCurrent();
    if (!glGetString(GL_VERSION))
      throw std::runtime_error(
          "render: another OpenGL library has taken the place of OSMesa, pictures would be blank; "
          "libOSMesa has to stand before libGL and VTK on the link line");
    OpenGLInit();
  }

  void MakeCurrent() override {
    if (context_ && !IsCurrent()) OSMesaMakeCurrent(context_, buffer_, GL_UNSIGNED_BYTE, side, side);
  }
  bool IsCurrent() override { return context_ && OSMesaGetCurrentContext() == context_; }
  int SupportsOpenGL() override { return 1; }
  vtkTypeBool IsDirect() override { return 0; }

  void Render() override {
    Initialize();
    MakeCurrent();
    Superclass::Render();
  }

  void OpenGLInitContext() override {
    if (Initialized) return;
    const GLenum result = glewInit();
    GlewInitValid = result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY;
    if (!GlewInitValid) throw std::runtime_error("render: GLEW cannot look up OpenGL's functions");
    Initialized = true;
  }

  void Finalize() override {
    if (!context_) return;
    MakeCurrent();
    Superclass::Finalize();
    OSMesaDestroyContext(context_);
    context_ = nullptr;
  }

 protected:
  OffscreenWindow() {
    SetOffScreenRendering(true);
    SetFrameBlitModeToNoBlit();
    SetReadyForRendering(true);
  }
  ~OffscreenWindow() override { OffscreenWindow::Finalize(); }

 private:
  static constexpr int side = 16;
  unsigned char buffer_[4 * side * side] = {};
  OSMesaContext context_ = nullptr;
};

vtkStandardNewMacro(OffscreenWindow);

}  // namespace

}  // namespace porosph::render

#endif

namespace porosph::render {

std::mutex& render_mutex() {
  static std::mutex mutex;
  return mutex;
}

vtkSmartPointer<vtkRenderWindow> make_offscreen_window(int width, int height) {
  auto window = vtkSmartPointer<OffscreenWindow>::New();
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  window->Initialize();
  return window;
}

}  // namespace porosph::render
