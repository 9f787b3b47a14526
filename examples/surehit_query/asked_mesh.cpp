#include "surehit_query/asked_mesh.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "command_line/program.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/read_mesh.hpp"
#include "surehit_query/baked_collider.hpp"
#include "surehit_query/exact_ties.hpp"
#include "surehit_query/hit_text.hpp"
#include "surehit_query/mask_list.hpp"
#include "surehit_query/query_limits.hpp"

namespace surehit::example {
namespace {

template <typename Scalar>
QueryOptions<Scalar> options_of(const QueryRequest& request) {
  auto options = limits_of<QueryOptions<Scalar>>(request);
  options.mask = request.mask;
  options.ignored_triangle = request.ignored_triangle.value_or(no_triangle);
  return options;
}

}  // namespace

template <typename Scalar>
ReadCollider<Scalar> read_collider(const QueryRequest& request) {
  if (std::optional<Collider<Scalar>> baked = load_baked<Scalar>(request)) return {*std::move(baked), {}};
  Mesh<Scalar> mesh = read_mesh<Scalar>(request.mesh_path);
  for (const std::string& warning : mesh.warnings) warn("surehit-query", request.mesh_path + ": " + warning);
  const std::vector<std::uint32_t> masks = masks_of(request, mesh);
  Collider<Scalar> collider;
  if (const BuildResult built = collider.try_build(mesh.view(), {.masks = masks}); !built) {
    throw InputError(request.mesh_path + ": " + built.error().what());
  }
  if (request.ids == IdKind::triangle) mesh.faces.clear();
  return {std::move(collider), std::move(mesh.faces)};
}

template <typename Scalar>
AskedMesh<Scalar>::AskedMesh(const QueryRequest& request)
    : options_(options_of<Scalar>(request)), id_column_(id_column(request)), mesh_(read_collider<Scalar>(request)) {}

template <typename Scalar>
void AskedMesh<Scalar>::append_id(std::uint32_t triangle, std::string& text) const {
  append_number(mesh_.id_of(triangle), text);
}

template <typename Scalar>
std::vector<std::uint8_t> AskedMesh<Scalar>::ties(const Path<Scalar>& path, const std::vector<Answer>& hits) const {
  return exact_ties(hits, [&](std::span<const Answer> some) { return turned_order(path, some); });
}

template <typename Scalar>
std::vector<std::uint32_t> AskedMesh<Scalar>::turned_order(const Path<Scalar>& path,
                                                           std::span<const Answer> hits) const {
  std::vector<std::array<Scalar, 3>> corners;
  for (std::size_t i = hits.size(); i-- > 0;) {
    const Triangle<Scalar> triangle = mesh_.collider.triangle(hits[i].triangle);
    for (const auto* corner : {&triangle.a, &triangle.b, &triangle.c}) {
      corners.push_back({corner->x(), corner->y(), corner->z()});
    }
  }
  std::vector<std::uint32_t> ids(corners.size());
  std::iota(ids.begin(), ids.end(), 0u);
  Collider<Scalar> turned;
  if (!turned.try_build({corners, ids})) return {};  // cannot be: the collider has taken each of them

  Options options = options_;
  options.mask = ~std::uint32_t{0};
  options.ignored_triangle = no_triangle;
  std::vector<Answer> in_turned_order;
  turned.all_hits(path, in_turned_order, options);
  std::vector<std::uint32_t> order(in_turned_order.size());
  std::transform(in_turned_order.begin(), in_turned_order.end(), order.begin(),
                 [](const Answer& hit) { return hit.triangle; });
  return order;
}

template ReadCollider<float> read_collider(const QueryRequest&);
template ReadCollider<double> read_collider(const QueryRequest&);
template class AskedMesh<float>;
template class AskedMesh<double>;

}  // namespace surehit::example
