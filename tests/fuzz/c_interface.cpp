// Calls of the C interface in any order, with any arguments that can be told from right ones: null, closed handles and
// those of other kinds, unknown values, numbers that are not finite, and counts that overflow. Each call succeeds, or
// fails with a message and changes nothing.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "byte_source.hpp"
#include "c_argument_drawer.hpp"
#include "collision/c/c_functions.hpp"
#include "finding.hpp"

namespace surehit::test {
namespace {

/// All handles that there are, and those that were closed, without their types.
using Handles = std::vector<void*>;

template <typename Scalar>
class CInterfaceCase : CArgumentDrawer<Scalar> {
 public:
  CInterfaceCase(ByteSource& bytes, Handles& handles) : Drawer(bytes), bytes_(bytes), handles_(handles) {
    for (std::size_t i = 0; i < 3 * vertex_count; ++i) vertices_.push_back(number());
    for (std::size_t i = 0; i < 3 * triangle_count; ++i) {
      indices_.push_back(static_cast<std::uint32_t>(bytes_.below(vertex_count + (bytes_.one_in(32) ? 1 : 0))));
      masks_.push_back(bytes_.take<std::uint8_t>());
    }
    for (auto*& collider : colliders_) {
      expect_status(C::create(nullptr, nullptr, &collider), SUREHIT_OK);
      handles_.push_back(collider);
    }
    expect_status(C::create_scene(&scene_), SUREHIT_OK);
    handles_.push_back(scene_);
  }
  ~CInterfaceCase() {
    for (auto* const collider : colliders_) (void)C::destroy(collider);
    (void)C::destroy_scene(scene_);
  }
  CInterfaceCase(const CInterfaceCase&) = delete;
  CInterfaceCase& operator=(const CInterfaceCase&) = delete;

  void call() {
    switch (bytes_.below(16)) {
      case 0:
        return build();
      case 1:
        return change_masks();
      case 2:
        return ask_collider();
      case 3:
        return ask_collider_in_batch();
      case 4:
        return ask_pair();
      case 5:
        return tell_of_collider();
      case 6:
        return change_scene();
      case 7:
        return ask_scene();
      case 8:
        return ask_scene_in_batch();
      case 9:
        return tell_of_scene();
      case 10:
        return move_vertices();
      case 11:
        return ask_about_shape();
      case 12:
        return ask_about_shapes_in_batch();
      case 13:
        return ask_scene_about_shape();
      case 14:
        return ask_scene_about_shapes_in_batch();
      default:
        return destroy();
    }
  }

 private:
  using C = CFunctions<Scalar>;
  using Collider = typename C::ColliderHandle;
  using Drawer = CArgumentDrawer<Scalar>;
  using Drawer::checked;
  using Drawer::choice_;
  using Drawer::executor_;
  using Drawer::expect_status;
  using Drawer::number;
  using Drawer::or_none;
  using Drawer::or_null;
  using Drawer::path;
  using Drawer::path_count;
  using Drawer::paths;
  using Drawer::pose;
  using Drawer::set_options;
  using Drawer::set_size;
  using Drawer::shape;
  using Drawer::shapes;
  using Drawer::size;
  using Drawer::small_value;
  using Drawer::triangle_count;
  using Drawer::value;
  using Drawer::vector;
  using Drawer::vertex_count;

  /// A collider, or now and then another handle as if it were one.
  Collider* collider() {
    if (bytes_.one_in(8)) return static_cast<Collider*>(handles_[bytes_.below(handles_.size())]);
    return or_null(colliders_[bytes_.below(colliders_.size())]);
  }
  typename C::SceneHandle* scene() {
    if (bytes_.one_in(8)) {
      return static_cast<typename C::SceneHandle*>(handles_[bytes_.below(handles_.size())]);
    }
    return or_null(scene_);
  }
  surehit_instance_id id() {
    if (ids_.empty() || bytes_.one_in(8)) return {value(4), value(2)};
    return ids_[bytes_.below(ids_.size())];
  }

  void build() {
    typename C::Mesh mesh = {or_null(vertices_.data()),      size(vertex_count),   0,
                             or_null(indices_.data()),       size(triangle_count), 0,
                             bytes_.one_in(8) ? value(8) : 4};
    if (bytes_.one_in(8)) mesh.vertex_stride = bytes_.below(3 * sizeof(Scalar));
    if (bytes_.one_in(8)) mesh.triangle_stride = bytes_.below(12);
    surehit_build_options options = {};
    set_size(options);
    options.executor = or_none(&executor_);
    options.resolution_x = value(9);
    options.crowded = value(3);
    if (bytes_.one_in(4)) options.cells_per_triangle = static_cast<double>(number());
    // A grid of very many cells is allowed, and takes its time.
    if (options.cells_per_triangle > 100) options.cells_per_triangle = 100;
    if (bytes_.one_in(4)) {
      options.masks = or_null(masks_.data());
      options.mask_count = size(triangle_count);
    }
    auto* const to = collider();
    const std::size_t before = count_of(to);
    const surehit_status status =
        bytes_.one_in(2) ? C::build(to, &mesh, or_none(&options)) : C::rebuild(to, &mesh, or_none(&options));
    checked(status, count_of(to), status == SUREHIT_OK ? count_of(to) : before);
    if (status == SUREHIT_OK) expect_status(C::check_mesh(&mesh), SUREHIT_OK);
  }
  static std::size_t count_of(const Collider* of) {
    std::size_t count = 0;
    (void)C::triangle_count(of, &count);
    return count;
  }
  void move_vertices() {
    checked(C::rebuild_vertices(collider(), or_null(vertices_.data()), size(vertex_count),
                                bytes_.one_in(8) ? bytes_.below(3 * sizeof(Scalar)) : 0, or_none(&executor_)));
  }
  void change_masks() {
    checked(C::set_mask(collider(), value(triangle_count), bytes_.take<std::uint8_t>()));
    checked(C::set_masks(collider(), or_null(masks_.data()), size(triangle_count)));
  }
  void destroy() {
    if (!bytes_.one_in(4)) return;
    checked(C::destroy(collider()));
    if (bytes_.one_in(4)) checked(C::destroy_scene(scene()));
  }

  void ask_collider() {
    const auto* const asked = collider();
    const auto way = path();
    auto options = C::default_options();
    set_options(options);
    const typename C::Filter filter = {Drawer::template accept<typename C::Hit>, &choice_};
    choice_ = bytes_.take<std::uint8_t>();
    surehit_statistics statistics = {};
    set_size(statistics);
    const auto* const given = or_none(&options);
    const auto* const given_filter = or_none(&filter);
    typename C::Hit hit;
    std::memset(&hit, 7, sizeof hit);
    const auto before = hit;
    if (checked(C::first_hit(asked, or_null(&way), given, given_filter, or_none(&statistics), or_null(&hit)), hit,
                before) != SUREHIT_OK) {
      return;
    }
    const bool is_hit = hit.triangle != SUREHIT_NO_TRIANGLE;
    std::uint8_t blocked = 2;
    std::array<typename C::Hit, triangle_count> hits;
    std::size_t count = 0;
    const surehit_status any = C::any_hit(asked, &way, given, given_filter, nullptr, &blocked);
    if (any == SUREHIT_OK && blocked != (is_hit ? 1 : 0)) stop_at("any_hit differs from first_hit");
    const surehit_status all =
        C::all_hits(asked, &way, given, given_filter, nullptr, hits.data(), bytes_.below(triangle_count + 1), &count);
    if (all == SUREHIT_OK && (count > 0) != is_hit) stop_at("all_hits differs from first_hit");
    if (!is_hit) return;
    if (bytes_.one_in(4)) hit.t = number();
    if (bytes_.one_in(4)) hit.triangle = value(triangle_count);
    if (bytes_.one_in(4)) explain(asked, way, given);
    typename C::Vector point;
    Scalar max_t = 0;
    checked(C::last_free_point(asked, &way, &hit, given, given_filter, &point));
    checked(C::max_t_keeping(asked, &way, &hit, &max_t));
    checked(C::point(&way, &hit, &point));
    checked(C::distance(&way, &hit, &max_t));
  }

  void explain(const Collider* asked, const typename C::Path& way, const typename C::Options* given) {
    typename C::Explainer explainer = {};
    set_size(explainer);
    if (bytes_.one_in(2)) explainer.hit = [](void*, std::size_t, const typename C::ExplainedHit*) {};
    if (bytes_.one_in(2)) explainer.cell = [](void*, std::size_t, const surehit_explained_cell*) {};
    std::uint32_t walk = 9;
    checked(C::explain(asked, &way, given, or_null(&explainer), or_null(&walk)), walk, std::uint32_t{9});
  }

  template <typename Filter, typename Batch, typename Options, typename Hit, typename Ways, typename FirstHits,
            typename AnyHits>
  void ask_in_batch(const void* asked, const Ways& ways, const Options& defaults, FirstHits first_hits,
                    AnyHits any_hits) {
    std::vector<Options> own(path_count, defaults);
    for (auto& one : own) set_options(one);
    const Filter filter = {Drawer::template accept<Hit>, &choice_};
    choice_ = bytes_.take<std::uint8_t>();
    surehit_statistics statistics = {};
    set_size(statistics);
    Batch batch = {};
    set_size(batch);
    batch.options = or_none(own.data());
    batch.path_options = or_none(own.data());
    batch.filter = or_none(&filter);
    batch.executor = or_none(&executor_);
    batch.statistics = or_none(&statistics);
    std::array<Hit, path_count> hits;
    std::memset(hits.data(), 7, sizeof hits);
    const auto before = hits;
    std::array<std::uint8_t, path_count> blocked = {};
    if (checked(first_hits(asked, &ways, or_none(&batch), or_null(hits.data())), hits, before) == SUREHIT_OK) {
      checked(any_hits(asked, &ways, nullptr, blocked.data()));
    }
  }
  void ask_collider_in_batch() {
    ask_in_batch<typename C::Filter, typename C::BatchOptions, typename C::Options, typename C::Hit>(
        collider(), paths(), C::default_options(),
        [](const void* asked, auto... rest) { return C::first_hits(static_cast<const Collider*>(asked), rest...); },
        [](const void* asked, auto... rest) { return C::any_hits(static_cast<const Collider*>(asked), rest...); });
  }
  void ask_scene_in_batch() {
    commit_all();
    using Scene = typename C::SceneHandle;
    ask_in_batch<typename C::SceneFilter, typename C::SceneBatchOptions, typename C::SceneOptions,
                 typename C::SceneHit>(
        scene(), paths(), C::default_scene_options(),
        [](const void* asked, auto... rest) { return C::scene_first_hits(static_cast<const Scene*>(asked), rest...); },
        [](const void* asked, auto... rest) { return C::scene_any_hits(static_cast<const Scene*>(asked), rest...); });
  }

  void ask_about_shape() {
    const auto* const asked = collider();
    const auto moving = shape();
    auto options = C::default_shape_options();
    set_options(options);
    const typename C::ShapeFilter filter = {Drawer::template accept<typename C::ShapeHit>, &choice_};
    choice_ = bytes_.take<std::uint8_t>();
    surehit_statistics statistics = {};
    set_size(statistics);
    const auto* const given = or_none(&options);
    const auto* const given_filter = or_none(&filter);
    typename C::ShapeHit hit;
    std::memset(&hit, 7, sizeof hit);
    const auto before = hit;
    if (checked(C::shape_first_hit(asked, or_null(&moving), given, given_filter, or_none(&statistics), or_null(&hit)),
                hit, before) != SUREHIT_OK) {
      return;
    }
    const bool is_hit = hit.triangle != SUREHIT_NO_TRIANGLE;
    std::uint8_t answer = 2;
    std::array<typename C::ShapeHit, triangle_count> hits;
    std::size_t count = 0;
    const surehit_status any = C::shape_any_hit(asked, &moving, given, given_filter, nullptr, &answer);
    if (any == SUREHIT_OK && answer != (is_hit ? 1 : 0)) stop_at("shape_any_hit differs from shape_first_hit");
    const surehit_status all = C::shape_all_hits(asked, &moving, given, given_filter, nullptr, hits.data(),
                                                 bytes_.below(triangle_count + 1), &count);
    if (all == SUREHIT_OK && (count > 0) != is_hit) stop_at("shape_all_hits differs from shape_first_hit");
    checked(C::shape_overlaps(asked, &moving, given, given_filter, or_none(&statistics), or_null(&answer)));
    const typename C::Triangle triangle = {vector(), vector(), vector()};
    checked(C::shape_intersect(or_null(&triangle), &moving, given, &hits[0]));
    typename C::Vector contact;
    checked(C::contact_point(or_null(&triangle), &hit, &contact));
    checked(C::contact_normal(or_null(&triangle), &moving, or_null(&contact)));
    if (!is_hit) return;
    if (bytes_.one_in(4)) hit.triangle = value(triangle_count);
    Scalar t = 0;
    checked(C::shape_last_free_t(asked, &moving, &hit, or_null(&t)));
    if (bytes_.one_in(4)) hit.t = number();
    checked(C::shape_last_free_point(asked, &moving, &hit, given, given_filter, or_null(&contact)));
  }
  void ask_about_shapes_in_batch() {
    ask_in_batch<typename C::ShapeFilter, typename C::ShapeBatchOptions, typename C::ShapeOptions,
                 typename C::ShapeHit>(
        collider(), shapes(), C::default_shape_options(),
        [](const void* asked, auto... rest) {
          return C::shape_first_hits(static_cast<const Collider*>(asked), rest...);
        },
        [](const void* asked, auto... rest) {
          return C::shape_any_hits(static_cast<const Collider*>(asked), rest...);
        });
  }
  void ask_scene_about_shapes_in_batch() {
    commit_all();
    using Scene = typename C::SceneHandle;
    ask_in_batch<typename C::SceneShapeFilter, typename C::SceneShapeBatchOptions, typename C::SceneShapeOptions,
                 typename C::SceneShapeHit>(
        scene(), shapes(), C::default_scene_shape_options(),
        [](const void* asked, auto... rest) {
          return C::scene_shape_first_hits(static_cast<const Scene*>(asked), rest...);
        },
        [](const void* asked, auto... rest) {
          return C::scene_shape_any_hits(static_cast<const Scene*>(asked), rest...);
        });
  }
  void ask_scene_about_shape() {
    const auto* const asked = scene();
    const auto moving = shape();
    auto options = C::default_scene_shape_options();
    set_options(options);
    if (bytes_.one_in(4)) options.instance_mask = bytes_.take<std::uint8_t>();
    if (bytes_.one_in(4)) options.ignored_instance = id();
    const typename C::SceneShapeFilter filter = {Drawer::template accept<typename C::SceneShapeHit>, &choice_};
    choice_ = bytes_.take<std::uint8_t>();
    const auto* const given = or_none(&options);
    const auto* const given_filter = or_none(&filter);
    commit_all();
    typename C::SceneShapeHit hit;
    std::memset(&hit, 7, sizeof hit);
    const auto before = hit;
    if (checked(C::scene_shape_first_hit(asked, or_null(&moving), given, given_filter, nullptr, or_null(&hit)), hit,
                before) != SUREHIT_OK) {
      return;
    }
    const bool is_hit = hit.triangle != SUREHIT_NO_TRIANGLE;
    std::uint8_t answer = 2;
    std::array<typename C::SceneShapeHit, triangle_count> hits;
    std::size_t count = 0;
    const surehit_status any = C::scene_shape_any_hit(asked, &moving, given, given_filter, nullptr, &answer);
    if (any == SUREHIT_OK && answer != (is_hit ? 1 : 0)) stop_at("scene_shape_any_hit differs from the first hit");
    const surehit_status all = C::scene_shape_all_hits(asked, &moving, given, given_filter, nullptr, hits.data(),
                                                       bytes_.below(triangle_count + 1), &count);
    if (all == SUREHIT_OK && (count > 0) != is_hit) stop_at("scene_shape_all_hits differs from the first hit");
    checked(C::scene_shape_overlaps(asked, &moving, given, given_filter, nullptr, or_null(&answer)));
    if (!is_hit) return;
    if (bytes_.one_in(4)) hit.triangle = value(triangle_count);
    if (bytes_.one_in(4)) hit.instance = id();
    Scalar t = 0;
    checked(C::scene_shape_last_free_t(asked, &moving, &hit, or_null(&t)));
    if (bytes_.one_in(4)) hit.t = number();
    typename C::Vector point;
    checked(C::scene_shape_last_free_point(asked, &moving, &hit, given, given_filter, or_null(&point)));
    checked(C::scene_contact_point(asked, &hit, or_null(&point)));
    checked(C::scene_contact_normal(asked, &moving, &hit, or_null(&point)));
  }

  void ask_pair() {
    const typename C::Triangle triangle = {vector(), vector(), vector()};
    const auto way = path();
    auto options = C::default_options();
    set_options(options);
    typename C::Hit hit = {};
    typename C::Vector normal;
    Scalar max_t = 0;
    checked(C::normal_of_triangle(or_null(&triangle), or_null(&normal)));
    if (checked(C::intersect(or_null(&triangle), or_null(&way), or_none(&options), or_null(&hit))) != SUREHIT_OK)
      return;
    checked(C::max_t_keeping_of_triangle(&triangle, &way, &hit, &max_t));
  }

  void tell_of_collider() {
    const auto* const asked = collider();
    typename C::Triangle triangle;
    typename C::Vector normal;
    typename C::Box box;
    surehit_grid_summary summary = {};
    std::uint32_t mask = 0;
    std::size_t bytes = 0;
    set_size(summary);
    checked(C::triangle(asked, value(triangle_count), or_null(&triangle)));
    checked(C::normal(asked, value(triangle_count), or_null(&normal)));
    checked(C::mask(asked, value(triangle_count), or_null(&mask)));
    checked(C::box(asked, or_null(&box)));
    checked(C::grid_summary(asked, or_null(&summary)));
    checked(C::memory_bytes(asked, or_null(&bytes)));
  }

  void change_scene() {
    auto* const to = scene();
    const auto given_pose = pose();
    const auto motion = vector();
    surehit_instance_id added = {};
    switch (bytes_.below(7)) {
      case 0:
        if (checked(C::add(to, collider(), or_none(&given_pose), bytes_.take<std::uint8_t>(), 1, or_null(&added))) ==
            SUREHIT_OK) {
          ids_.push_back(added);
        }
        break;
      case 1:
        checked(C::set_pose(to, id(), or_null(&given_pose)));
        break;
      case 2:
        checked(C::set_motion(to, id(), or_null(&motion)));
        break;
      case 3:
        checked(C::set_instance_mask(to, id(), bytes_.take<std::uint8_t>()));
        break;
      case 4:
        checked(C::remove(to, id()));
        break;
      case 5:
        checked(C::set_collider(to, id(), collider()));
        break;
      default:
        break;
    }
    checked(C::commit(to, or_none(&executor_)));
  }
  void ask_scene() {
    const auto* const asked = scene();
    const auto way = path();
    auto options = C::default_scene_options();
    set_options(options);
    if (bytes_.one_in(4)) options.instance_mask = bytes_.take<std::uint8_t>();
    if (bytes_.one_in(4)) options.ignored_instance = id();
    const typename C::SceneFilter filter = {Drawer::template accept<typename C::SceneHit>, &choice_};
    choice_ = bytes_.take<std::uint8_t>();
    commit_all();
    typename C::SceneHit hit;
    std::memset(&hit, 7, sizeof hit);
    const auto before = hit;
    if (checked(C::scene_first_hit(asked, or_null(&way), or_none(&options), or_none(&filter), nullptr, or_null(&hit)),
                hit, before) != SUREHIT_OK) {
      return;
    }
    if (hit.triangle == SUREHIT_NO_TRIANGLE) return;
    typename C::Vector point;
    typename C::Triangle corners;
    checked(C::scene_last_free_point(asked, &way, &hit, &options, nullptr, &point));
    expect_status(C::placed_triangle(asked, hit.instance, hit.triangle, &corners), SUREHIT_OK);
  }
  /// A collider that was rebuilt needs a commit before its scenes are asked.
  void commit_all() { (void)C::commit(scene_, nullptr); }
  void tell_of_scene() {
    const auto* const asked = scene();
    typename C::Pose told;
    typename C::Vector motion;
    typename C::Triangle triangle;
    typename C::Box box;
    std::array<surehit_instance_id, 4> ids;
    std::uint8_t is_there = 0;
    std::size_t count = 0;
    checked(C::pose(asked, id(), or_null(&told)));
    checked(C::motion(asked, id(), or_null(&motion)));
    checked(C::contains(asked, id(), or_null(&is_there)));
    checked(C::instances(asked, or_null(ids.data()), bytes_.below(ids.size() + 1), or_null(&count)));
    checked(C::placed_triangle(asked, id(), value(triangle_count), or_null(&triangle)));
    checked(C::placed_normal(asked, id(), value(triangle_count), or_null(&motion)));
    checked(C::instance_triangle_count(asked, id(), or_null(&count)));
    checked(C::scene_box(asked, or_null(&box)));
  }

  ByteSource& bytes_;
  Handles& handles_;
  std::vector<Scalar> vertices_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::uint32_t> masks_;
  std::array<Collider*, 2> colliders_ = {};
  typename C::SceneHandle* scene_ = nullptr;
  std::vector<surehit_instance_id> ids_;
};

}  // namespace
}  // namespace surehit::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  surehit::test::ByteSource bytes(std::span(data, size));
  surehit::test::Handles handles;
  surehit::test::CInterfaceCase<float> floats(bytes, handles);
  surehit::test::CInterfaceCase<double> doubles(bytes, handles);
  while (!bytes.is_empty()) {
    if (bytes.one_in(2)) {
      doubles.call();
    } else {
      floats.call();
    }
  }
  return 0;
}
