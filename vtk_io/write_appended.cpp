#include "vtk_io/write_appended.hpp"

#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkXMLWriter.h>

#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/vtk_errors.hpp"

namespace porosph {

void write_appended(vtkXMLWriter& writer, const std::filesystem::path& file) {
  vtkNew<VtkErrors> errors;
  errors->watch(writer);
  errors->watch(*writer.GetExecutive());
  writer.SetDataModeToAppended();
  writer.EncodeAppendedDataOff();
  writer.SetCompressorTypeToZLib();
  writer.SetHeaderTypeToUInt64();
  replace_file(file, [&](const std::filesystem::path& temporary) {
    writer.SetFileName(temporary.c_str());
    const bool written = writer.Write() != 0;
    if (const auto code = writer.GetErrorCode(); code != vtkErrorCode::NoError)
      throw WriteError(file, words_of(code));
    if (!written || errors->any()) throw WriteError(file, errors->first());
  });
}

}  // namespace porosph
