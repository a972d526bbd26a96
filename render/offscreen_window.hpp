// A render window that needs no display: VTK draws through EGL or OSMesa.
#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <mutex>

namespace porosph::render {

/// VTK crashes when two threads draw at once: hold this from building a scene until its picture is saved.
std::mutex& render_mutex();

/// A window of the given size in pixels, no multisampling, its OpenGL context checked to work.
/// Throws std::runtime_error where OSMesa gives no context or another OpenGL library has taken its place.
vtkSmartPointer<vtkRenderWindow> make_offscreen_window(int width, int height);

}  // namespace porosph::render
