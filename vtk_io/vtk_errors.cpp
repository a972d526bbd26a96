#include "vtk_io/vtk_errors.hpp"

#include <vtkErrorCode.h>

#include <string_view>
#include <system_error>

namespace porosph {
namespace {

/// "ERROR: In x.cxx, line 1\nvtkX (0x1): text\n\n" -> "text"
std::string text_of(std::string_view message) {
  constexpr std::string_view mark = "): ";
  if (const auto prefix = message.find(mark); prefix != message.npos)
    message.remove_prefix(prefix + mark.size());
  return std::string(message.substr(0, message.find('\n')));
}

}  // namespace

std::string words_of(unsigned long code) {
  if (code == vtkErrorCode::OutOfDiskSpaceError)
    return std::make_error_code(std::errc::no_space_on_device).message();
  return vtkErrorCode::GetStringFromErrorCode(code);
}

void VtkErrors::watch(vtkObject& object) {
  object.AddObserver(vtkCommand::ErrorEvent, this);
  object.AddObserver(vtkCommand::WarningEvent, this);
}

void VtkErrors::Execute(vtkObject*, unsigned long event, void* data) {
  if (event != vtkCommand::ErrorEvent || any_) return;
  any_ = true;
  if (data != nullptr) first_ = text_of(static_cast<const char*>(data));
}

}  // namespace porosph
