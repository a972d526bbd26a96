// VTK's errors as values, instead of text on the console.
#pragma once

#include <vtkCommand.h>
#include <vtkObject.h>
#include <vtkSmartPointer.h>

#include <string>

namespace porosph {

/// Catches the errors and warnings of the VTK objects that it watches, which then do not print them.
class VtkErrors : public vtkCommand {
 public:
  static VtkErrors* New() { return new VtkErrors; }
  void watch(vtkObject& object);
  bool any() const { return any_; }                    ///< whether there was an error
  const std::string& first() const { return first_; }  ///< its text, without source line and address

  void Execute(vtkObject* caller, unsigned long event, void* data) override;

 private:
  bool any_ = false;
  std::string first_;
};

/// What a code of vtkErrorCode means, in the words of the system where it has some.
std::string words_of(unsigned long code);

}  // namespace porosph
