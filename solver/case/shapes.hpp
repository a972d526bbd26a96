// What the check of a case asks about outlines and soils.
#pragma once

#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// What is wrong with an outline: points given twice, no area, crossing itself. Empty if nothing is.
std::string outline_fault(const Polygon& outline);

/// What is wrong with the holes of a soil whose outlines are right: outside, touching or overlapping. Empty
/// if nothing.
std::string holes_fault(const SoilCase& soil);

double area(const SoilCase& soil);                          ///< without its holes [m2]
double thickness(const Polygon& outline);                   ///< least width of its convex hull [m]
double overlap(const SoilCase& a, const SoilCase& b);       ///< common area [m2]
double distance(const SoilCase& a, const SoilCase& b);      ///< 0 if they touch or overlap [m]
double distance(const Point& point, const SoilCase& soil);  ///< 0 inside and on the outline [m]

/// Length along which soils i and j face each other across less than `width` with no soil between [m]: of
/// cracks and pointed slits; 0 where they touch without one.
double slit_length(const std::vector<SoilCase>& soils, std::size_t i, std::size_t j, double width);

/// Where two straight segments cross or touch; nothing if they do not or lie in one line.
std::vector<Point> crossings(const Point& a, const Point& b, const Point& c, const Point& d);

/// Least distance of two segments [m].
double distance(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace porosph
