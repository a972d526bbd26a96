// What was found of a factor of safety, as a study: a page of its own, and a part of reports.
#pragma once

#include "render/report/study.hpp"
#include "vtk_io/run_folder/safety_files.hpp"

namespace porosph::render {

/// `command`: the command line that makes it. Its pictures and files are those that porosph safety writes.
Study safety_study(const SafetyAnswer& answer, const std::string& command);

}  // namespace porosph::render
