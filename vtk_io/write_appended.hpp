// Writes a VTK XML file as a whole or not at all.
#pragma once

#include <filesystem>

class vtkXMLWriter;

namespace porosph {

/// Compressed, with its data as raw bytes at the end. The writer has its input. Throws WriteError.
void write_appended(vtkXMLWriter& writer, const std::filesystem::path& file);

}  // namespace porosph
