// Element tests as a laboratory draws them.
#pragma once

#include "render/chart.hpp"
#include "vtk_io/run_folder/element_csv.hpp"

namespace porosph::render {

/// Four charts of runs of one test: q over p', q over strain, volume strain over strain, and what else the
/// test is made for: pore pressure, friction angle, or volume strain over the logarithm of stress.
ChartFigure element_figure(const std::vector<ElementRun>& runs, const std::string& title);

}  // namespace porosph::render
