#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "c/arguments.hpp"
#include "c/asked.hpp"
#include "c/values.hpp"
#include "surehit/c/shape_values_d.h"
#include "surehit/c/shape_values_f.h"
#include "surehit/collider.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/shape_options.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/swept_shape.hpp"
#include "surehit/swept_sphere.hpp"

namespace surehit::c {

/// The structs that moving shapes of the C interface have.
template <typename Scalar>
struct ShapeStructs;

#define SUREHIT_SHAPE_STRUCTS(Scalar, s)                 \
  template <>                                            \
  struct ShapeStructs<Scalar> {                          \
    using Shape = surehit_swept_shape##s;                \
    using Shapes = surehit_swept_shapes##s;              \
    using Hit = surehit_shape_hit##s;                    \
    using QueryOptions = surehit_shape_query_options##s; \
    using BatchOptions = surehit_shape_batch_options##s; \
    using Filter = surehit_shape_filter##s;              \
  };
SUREHIT_SHAPE_STRUCTS(float, f)
SUREHIT_SHAPE_STRUCTS(double, d)
#undef SUREHIT_SHAPE_STRUCTS

/// The number of `surehit_shape_kind`s.
inline constexpr std::uint32_t shape_kinds = 3;

/// Fails unless the shape can be read.
template <typename CShape>
void check_shape(Arguments& arguments, const CShape* shape) {
  arguments.check_pointer(shape, "shape");
  if (arguments.are_valid()) arguments.check_value(shape->kind, shape_kinds, 0, "the kind of the shape");
}

/// Returns a shape that has been checked.
template <typename Scalar>
[[nodiscard]] SweptShape<Scalar> shape_of(const typename ShapeStructs<Scalar>::Shape& shape) {
  switch (shape.kind) {
    case SUREHIT_SWEPT_BOX:
      return SweptBox<Scalar>{from_c(shape.start), from_c(shape.end), from_c(shape.half)};
    case SUREHIT_SWEPT_CAPSULE:
      return SweptCapsule<Scalar>{from_c(shape.start), from_c(shape.end), from_c(shape.half), shape.radius};
    default:
      return SweptSphere<Scalar>{from_c(shape.start), from_c(shape.end), shape.radius};
  }
}

/// The shapes of a batch of C.
template <typename ScalarOfShapes>
class AskedShapes {
 public:
  using Scalar = ScalarOfShapes;
  using CPaths = typename ShapeStructs<Scalar>::Shapes;

  /// Checks the shapes.
  AskedShapes(Arguments& arguments, const CPaths* shapes) {
    arguments.check_pointer(shapes, "shapes");
    if (!arguments.are_valid()) return;
    given_ = *shapes;
    arguments.check_value(given_.kind, shape_kinds, 0, "shapes.kind");
    if (!arguments.are_valid()) return;
    const std::size_t size = std::visit([](auto of_kind) { return sizeof(*of_kind.data()); }, span());
    arguments.check_array(given_.numbers, given_.count, size, "shapes.numbers");
  }

  /// Returns the number of shapes.
  [[nodiscard]] std::size_t size() const { return given_.count; }
  /// Returns the shapes, which must be valid.
  [[nodiscard]] SweptShapeSpan<Scalar> span() const {
    switch (given_.kind) {
      case SUREHIT_SWEPT_BOX:
        return as<SweptBox<Scalar>>();
      case SUREHIT_SWEPT_CAPSULE:
        return as<SweptCapsule<Scalar>>();
      default:
        return as<SweptSphere<Scalar>>();
    }
  }

 private:
  template <typename Shape>
  [[nodiscard]] std::span<const Shape> as() const {
    static_assert(sizeof(Shape) % sizeof(Scalar) == 0 && alignof(Shape) == alignof(Scalar));
    return {reinterpret_cast<const Shape*>(given_.numbers), given_.count};
  }

  CPaths given_ = {};
};

/// What is asked about moving shapes. `Object` is a collider or a scene.
template <typename Object>
struct ShapesIn;

/// The types of queries about shapes by their names, of which some are in C.
template <typename Object, typename Scalar, typename Answer, typename Options, typename AnyBatchOptions,
          typename CStructs>
struct AskedAboutShapes : AskedTypes<Object, Scalar, Answer, Options, AnyBatchOptions, CStructs> {
  using CPath = typename ShapeStructs<Scalar>::Shape;
  using Paths = AskedShapes<Scalar>;
  static constexpr const char* name = Asked<Object>::name;

  /// Fails unless the shape can be read.
  static void check(Arguments& arguments, const CPath* shape) { check_shape(arguments, shape); }
  /// Returns the shape, which must have been checked.
  [[nodiscard]] static SweptShape<Scalar> path_of(const CPath& shape) { return shape_of<Scalar>(shape); }
};

template <typename Scalar>
struct Asked<ShapesIn<Collider<Scalar>>>
    : AskedAboutShapes<Collider<Scalar>, Scalar, ShapeHit<Scalar>, ShapeQueryOptions<Scalar>, ShapeBatchOptions<Scalar>,
                       ShapeStructs<Scalar>> {
  using typename Asked::AskedTypes::Answer;
  using typename Asked::AskedTypes::CHit;
  using typename Asked::AskedTypes::COptions;
  using typename Asked::AskedTypes::Options;

  /// Returns options that have been checked. Null means the defaults.
  [[nodiscard]] static Options options_of(const COptions* given) {
    if (given == nullptr) return {};
    return {given->max_t, static_cast<Culling>(given->culling), given->mask, given->ignored_triangle,
            given->ignore_start_contact != 0};
  }
  /// Returns a hit, which may have any numbers.
  [[nodiscard]] static Answer from_c(const CHit& hit) {
    return {hit.t, hit.u, hit.v, hit.triangle, static_cast<Feature>(hit.feature), hit.started_touching != 0};
  }
  /// Returns a hit for the caller.
  [[nodiscard]] static CHit to_c(const Answer& hit) {
    return {hit.t,
            hit.u,
            hit.v,
            hit.triangle,
            static_cast<std::uint8_t>(hit.feature),
            static_cast<std::uint8_t>(hit.started_touching ? 1 : 0)};
  }
};

// As for paths. The arrays of shapes are read where they are too.
#define SUREHIT_SAME_SHAPE_LAYOUT(Scalar, s)                                                        \
  static_assert(sizeof(SweptSphere<Scalar>) == sizeof(surehit_swept_sphere##s));                    \
  SUREHIT_SAME_MEMBER(SweptSphere<Scalar>, surehit_swept_sphere##s, start);                         \
  SUREHIT_SAME_MEMBER(SweptSphere<Scalar>, surehit_swept_sphere##s, end);                           \
  SUREHIT_SAME_MEMBER(SweptSphere<Scalar>, surehit_swept_sphere##s, radius);                        \
  static_assert(sizeof(SweptBox<Scalar>) == sizeof(surehit_swept_box##s));                          \
  SUREHIT_SAME_MEMBER(SweptBox<Scalar>, surehit_swept_box##s, start);                               \
  SUREHIT_SAME_MEMBER(SweptBox<Scalar>, surehit_swept_box##s, end);                                 \
  SUREHIT_SAME_MEMBER(SweptBox<Scalar>, surehit_swept_box##s, half_extents);                        \
  static_assert(sizeof(SweptCapsule<Scalar>) == sizeof(surehit_swept_capsule##s));                  \
  SUREHIT_SAME_MEMBER(SweptCapsule<Scalar>, surehit_swept_capsule##s, start);                       \
  SUREHIT_SAME_MEMBER(SweptCapsule<Scalar>, surehit_swept_capsule##s, end);                         \
  SUREHIT_SAME_MEMBER(SweptCapsule<Scalar>, surehit_swept_capsule##s, half_axis);                   \
  SUREHIT_SAME_MEMBER(SweptCapsule<Scalar>, surehit_swept_capsule##s, radius);                      \
  static_assert(sizeof(ShapeHit<Scalar>) == sizeof(surehit_shape_hit##s));                          \
  SUREHIT_SAME_MEMBER(ShapeHit<Scalar>, surehit_shape_hit##s, t);                                   \
  SUREHIT_SAME_MEMBER(ShapeHit<Scalar>, surehit_shape_hit##s, u);                                   \
  SUREHIT_SAME_MEMBER(ShapeHit<Scalar>, surehit_shape_hit##s, v);                                   \
  SUREHIT_SAME_MEMBER(ShapeHit<Scalar>, surehit_shape_hit##s, triangle);                            \
  SUREHIT_SAME_MEMBER(ShapeHit<Scalar>, surehit_shape_hit##s, feature);                             \
  SUREHIT_SAME_MEMBER(ShapeHit<Scalar>, surehit_shape_hit##s, started_touching);                    \
  static_assert(sizeof(ShapeQueryOptions<Scalar>) == sizeof(surehit_shape_query_options##s));       \
  SUREHIT_SAME_MEMBER(ShapeQueryOptions<Scalar>, surehit_shape_query_options##s, max_t);            \
  SUREHIT_SAME_MEMBER(ShapeQueryOptions<Scalar>, surehit_shape_query_options##s, culling);          \
  SUREHIT_SAME_MEMBER(ShapeQueryOptions<Scalar>, surehit_shape_query_options##s, mask);             \
  SUREHIT_SAME_MEMBER(ShapeQueryOptions<Scalar>, surehit_shape_query_options##s, ignored_triangle); \
  SUREHIT_SAME_MEMBER(ShapeQueryOptions<Scalar>, surehit_shape_query_options##s, ignore_start_contact)
SUREHIT_SAME_SHAPE_LAYOUT(float, f);
SUREHIT_SAME_SHAPE_LAYOUT(double, d);

}  // namespace surehit::c
