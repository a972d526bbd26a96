// Arrays of plane vectors, and of plane tensors that are not symmetric.
#pragma once

#include <array>
#include <vector>

#include "solver/space/tensor.hpp"

namespace porosph {

using PlaneTensor = std::array<double, 4>;  ///< xx, xy, yx, yy

inline Mat2 matrix(const PlaneTensor& t) { return (Mat2() << t[0], t[1], t[2], t[3]).finished(); }
inline PlaneTensor plane_tensor(const Mat2& m) { return {m(0, 0), m(0, 1), m(1, 0), m(1, 1)}; }

/// One array for each of x and y, as loops over particles read them.
struct PlaneVectors {
  std::array<std::vector<double>, 2> component;

  bool empty() const { return component[0].empty(); }
  void resize(std::size_t size) {
    for (auto& c : component) c.resize(size);
  }
  Vec2 operator[](std::size_t i) const { return {component[0][i], component[1][i]}; }
  void set(std::size_t i, const Vec2& v) { component[0][i] = v.x(), component[1][i] = v.y(); }
};

/// One array for each of xx, xy, yx and yy, as loops over particles read them.
struct PlaneTensors {
  std::array<std::vector<double>, 4> component;

  void resize(std::size_t size) {
    for (auto& c : component) c.resize(size);
  }
  void assign(std::size_t size, const Mat2& m) {
    for (int k = 0; k < 4; ++k) component[k].assign(size, m(k / 2, k % 2));
  }
  Mat2 operator[](std::size_t i) const {
    return (Mat2() << component[0][i], component[1][i], component[2][i], component[3][i]).finished();
  }
  void set(std::size_t i, const Mat2& m) {
    for (int k = 0; k < 4; ++k) component[k][i] = m(k / 2, k % 2);
  }
  template <class Pointer>
  void connect(Pointer (&out)[4]) {
    for (int k = 0; k < 4; ++k) out[k] = component[k].data();
  }
};

}  // namespace porosph
