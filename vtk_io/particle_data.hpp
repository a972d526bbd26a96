// Particle data of one instant: Frame <-> VTK's PolyData.
#pragma once

#include <vtkCellArray.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "solver/case/case.hpp"
#include "solver/output/frame.hpp"

namespace porosph {

inline constexpr const char* time_array = "TimeValue";  ///< field data: time [s], the name ParaView looks for
inline constexpr const char* step_array = "Step";       ///< field data: number of the time step

/// One vertex cell per particle.
vtkSmartPointer<vtkCellArray> vertices(vtkIdType particles);

/// The frame as PolyData, units in the arrays' UNITS_LABEL, with one vertex cell per particle (ParaView shows
/// no points without cells). The arrays are borrowed, not copied, but for those that become single: `frame`
/// must outlive what is returned, which must not be written to. Points are always double. Throws
/// std::invalid_argument if a field's size does not fit the number of points, or names are not unique.
vtkSmartPointer<vtkPolyData> view_of(const Frame& frame, FramePrecision precision = FramePrecision::full);

/// The inverse. Arrays other than of 64-bit floats and 32-bit integers are converted to 64-bit floats.
Frame frame_of(vtkPolyData& data);

}  // namespace porosph
