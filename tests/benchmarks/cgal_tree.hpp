#pragma once

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <surehit/path.hpp>
#include <surehit/triangle.hpp>
#include <vector>

namespace surehit::benchmark {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalTriangles = std::vector<CgalKernel::Triangle_3>;
using CgalPrimitive = CGAL::AABB_triangle_primitive<CgalKernel, CgalTriangles::const_iterator>;
using CgalTree = CGAL::AABB_tree<CGAL::AABB_traits<CgalKernel, CgalPrimitive>>;

inline CgalKernel::Point_3 to_cgal(const Vector3f& point) {
  return {double{point.x()}, double{point.y()}, double{point.z()}};
}

inline CgalKernel::Segment_3 to_cgal(const Segmentf& segment) { return {to_cgal(segment.start), to_cgal(segment.end)}; }

/// Expects that origin and direction have a sum that is a double, because the kernel rounds it.
inline CgalKernel::Ray_3 to_cgal(const Rayf& ray) {
  return {to_cgal(ray.origin), CgalKernel::Vector_3(CGAL::ORIGIN, to_cgal(ray.direction))};
}

inline CgalKernel::Triangle_3 to_cgal(const Trianglef& triangle) {
  return {to_cgal(triangle.a), to_cgal(triangle.b), to_cgal(triangle.c)};
}

}  // namespace surehit::benchmark
