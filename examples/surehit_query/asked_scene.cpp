#include "surehit_query/asked_scene.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "command_line/program.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/text_lines.hpp"
#include "surehit_query/exact_ties.hpp"
#include "surehit_query/hit_text.hpp"
#include "surehit_query/mask_list.hpp"
#include "surehit_query/query_limits.hpp"

namespace surehit::example {
namespace {

/// Returns a collider of one triangle.
template <typename Scalar>
std::shared_ptr<const Collider<Scalar>> collider_of(const Triangle<Scalar>& triangle) {
  const std::array<Vector3<Scalar>, 3> corners = {triangle.a, triangle.b, triangle.c};
  constexpr std::array<std::uint32_t, 3> ids = {0, 1, 2};
  auto collider = std::make_shared<Collider<Scalar>>();
  if (!collider->try_build({corners, ids})) return nullptr;  // cannot be: a collider has taken it
  return collider;
}

}  // namespace

template <typename Scalar>
AskedScene<Scalar>::AskedScene(const QueryRequest& request) : id_column_(id_column(request)) {
  const std::vector<PlacedMesh<Scalar>> placed_meshes = read_scene<Scalar>(request.scene_path);
  const std::string shown_path = request.scene_path == "-" ? "standard input" : request.scene_path;
  for (const PlacedMesh<Scalar>& placed : placed_meshes) {
    try {
      add(placed, request);
    } catch (const InputError& error) {
      throw at_line(error, placed.line).at(shown_path);
    }
  }
  if (placed_meshes.empty()) warn("surehit-query", shown_path + ": the scene has no instances, so nothing is ever hit");
  scene_.commit();
  options_ = options_of(request);
}

template <typename Scalar>
typename AskedScene<Scalar>::SharedMesh AskedScene<Scalar>::mesh_of(const PlacedMesh<Scalar>& placed,
                                                                    const QueryRequest& request) {
  SharedMesh& mesh = meshes_[placed.mesh_path];
  if (mesh == nullptr) {
    QueryRequest of_mesh = request;
    of_mesh.mesh_path = placed.mesh_path;
    of_mesh.ignored_triangle.reset();  // It is one of a single instance.
    mesh = std::make_shared<const ReadCollider<Scalar>>(read_collider<Scalar>(of_mesh));
  }
  return mesh;
}

template <typename Scalar>
void AskedScene<Scalar>::add(const PlacedMesh<Scalar>& placed, const QueryRequest& request) {
  const SharedMesh mesh = mesh_of(placed, request);
  const InstanceOptions options{.mask = placed.mask, .user_data = instances_.size()};
  // The pointer to the collider keeps the mesh.
  const std::shared_ptr<const Collider<Scalar>> collider(mesh, &mesh->collider);
  const InstanceResult added = scene_.try_add(collider, placed.pose, options);
  if (!added) throw InputError(added.error().what());
  const InstanceResult moved = scene_.try_set_motion(added.id(), placed.motion);
  if (!moved) throw InputError(moved.error().what());
  instances_.push_back({added.id(), mesh});
}

template <typename Scalar>
typename AskedScene<Scalar>::Options AskedScene<Scalar>::options_of(const QueryRequest& request) const {
  auto options = limits_of<Options>(request);
  options.instance_mask = request.mask;
  check_is_there(request.ignored_instance, instances_.size(), "instance");
  if (request.ignored_instance) {
    const Placed& ignored = instances_[*request.ignored_instance];
    options.ignored_instance = ignored.id;
    check_is_there(request.ignored_triangle, ignored.mesh->collider.triangle_count(), "triangle");
    options.ignored_triangle = request.ignored_triangle.value_or(no_triangle);
  }
  return options;
}

template <typename Scalar>
const typename AskedScene<Scalar>::Placed& AskedScene<Scalar>::placed_of(InstanceId instance) const {
  return instances_[scene_.user_data(instance)];
}

template <typename Scalar>
void AskedScene<Scalar>::append_ids(InstanceId instance, std::uint32_t triangle, std::string& text) const {
  append_number(scene_.user_data(instance), text);
  text += ',';
  append_number(placed_of(instance).mesh->id_of(triangle), text);
}

template <typename Scalar>
std::vector<std::uint8_t> AskedScene<Scalar>::ties(const Path<Scalar>& path, const std::vector<Answer>& hits) const {
  return exact_ties(hits, [&](std::span<const Answer> some) { return turned_order(path, some); });
}

template <typename Scalar>
std::vector<std::uint32_t> AskedScene<Scalar>::turned_order(const Path<Scalar>& path,
                                                            std::span<const Answer> hits) const {
  Scene<Scalar> turned;
  for (std::size_t i = hits.size(); i-- > 0;) {
    const Placed& placed = placed_of(hits[i].instance);
    const InstanceOptions number{.user_data = hits.size() - 1 - i};
    const InstanceResult added =
        turned.try_add(collider_of(placed.mesh->collider.triangle(hits[i].triangle)), scene_.pose(placed.id), number);
    if (!added || !turned.try_set_motion(added.id(), scene_.motion(placed.id))) return {};  // cannot be
  }
  turned.commit();

  Options options = options_;
  options.instance_mask = ~std::uint32_t{0};
  options.ignored_instance = {};
  std::vector<Answer> in_turned_order;
  turned.all_hits(path, in_turned_order, options);
  std::vector<std::uint32_t> order(in_turned_order.size());
  std::transform(in_turned_order.begin(), in_turned_order.end(), order.begin(),
                 [&](const Answer& hit) { return static_cast<std::uint32_t>(turned.user_data(hit.instance)); });
  return order;
}

template class AskedScene<float>;
template class AskedScene<double>;

}  // namespace surehit::example
