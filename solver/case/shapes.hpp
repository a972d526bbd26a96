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

double area(const SoilCase& soil);         ///< without its holes [m2]
double thickness(const Polygon& outline);  ///< least width of its convex hull [m]
/// What two soils have in common.
struct Overlap {
  double area = 0;                                  ///< [m2]
  Point low = Point::Zero(), high = Point::Zero();  ///< corners of the box around it [m]
};
Overlap overlap(const SoilCase& a, const SoilCase& b);
double distance(const SoilCase& a, const SoilCase& b);  ///< 0 if they touch or overlap [m]
std::pair<Point, Point> nearest_points(const SoilCase& a, const SoilCase& b);  ///< of two that are apart [m]
double distance(const Point& point, const SoilCase& soil);  ///< 0 inside and on the outline [m]

/// What of a soil lies inside of an outline, or outside of it: pieces that hang together, with the soil's
/// settings, those of less than `least` [m2] left out.
std::vector<SoilCase> parts_of(const SoilCase& soil, const Polygon& outline, bool inside, double least);
double highest_point(const SoilCase& soil);  ///< y [m]

/// Where soils i and j face each other across less than `width` [m] with no soil between: cracks and pointed
/// slits.
struct Slit {
  double length = 0;            ///< 0 where they touch without one [m]
  Point place = Point::Zero();  ///< a point in it [m]
};
Slit find_slit(const std::vector<SoilCase>& soils, std::size_t i, std::size_t j, double width);

/// Where two straight segments cross or touch; nothing if they do not or lie in one line.
std::vector<Point> crossings(const Point& a, const Point& b, const Point& c, const Point& d);

/// Least distance of two segments [m].
double distance(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace porosph
