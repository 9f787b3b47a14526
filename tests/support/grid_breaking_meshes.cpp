#include "support/grid_breaking_meshes.hpp"

#include <map>

namespace surehit::test {
namespace {

template <typename Scalar>
Vector3<Scalar> in_cube(Random& random) {
  const Scalar x = random.symmetric<Scalar>();
  const Scalar y = random.symmetric<Scalar>();
  return {x, y, random.symmetric<Scalar>()};
}

using LatticePoint = std::array<std::int32_t, 3>;

/// Gives every lattice point one vertex, however many triangles ask for it.
class LatticeVertices {
 public:
  std::uint32_t operator()(const LatticePoint& point) {
    const auto [entry, is_new] = ids_.try_emplace(point, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(point);
    return entry->second;
  }
  [[nodiscard]] const std::vector<LatticePoint>& points() const { return points_; }

 private:
  std::map<LatticePoint, std::uint32_t> ids_;
  std::vector<LatticePoint> points_;
};

template <typename Scalar>
Vector3<Scalar> vertex(const LatticePoint& point, std::int32_t factor = 1) {
  return {static_cast<Scalar>(point[0] * factor), static_cast<Scalar>(point[1] * factor),
          static_cast<Scalar>(point[2] * factor)};
}

/// `count` × `count` squares of two triangles over [-1, 1]².
template <typename Scalar, typename HeightAt>
GeneratedMesh<Scalar> ground(std::uint32_t count, const HeightAt& height_at) {
  GeneratedMesh<Scalar> mesh;
  const Scalar step = 2 / static_cast<Scalar>(count);
  for (std::uint32_t y = 0; y <= count; ++y) {
    for (std::uint32_t x = 0; x <= count; ++x) {
      const Scalar at_x = static_cast<Scalar>(x) * step - 1;
      const Scalar at_y = static_cast<Scalar>(y) * step - 1;
      mesh.vertices.emplace_back(at_x, at_y, height_at(at_x, at_y));
    }
  }
  for (std::uint32_t y = 0; y < count; ++y) {
    for (std::uint32_t x = 0; x < count; ++x) {
      const std::uint32_t corner = y * (count + 1) + x;
      const std::uint32_t above = corner + count + 1;
      mesh.triangles.push_back({corner, corner + 1, above + 1});
      mesh.triangles.push_back({corner, above + 1, above});
    }
  }
  return mesh;
}

}  // namespace

template <typename Scalar>
void GeneratedMesh<Scalar>::add(const Triangle<Scalar>& triangle) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), {triangle.a, triangle.b, triangle.c});
  triangles.push_back({first, first + 1, first + 2});
}

template <typename Scalar>
TriangleMeshView<Scalar> GeneratedMesh<Scalar>::view() const {
  return {vertices, triangles};
}

template <typename Scalar>
GeneratedMesh<Scalar> scattered_triangles(std::size_t count, Scalar size, Random& random) {
  GeneratedMesh<Scalar> mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3<Scalar> a = in_cube<Scalar>(random);
    const Vector3<Scalar> b = a + size * in_cube<Scalar>(random);
    mesh.add({a, b, a + size * in_cube<Scalar>(random)});
  }
  return mesh;
}

template <typename Scalar>
GeneratedMesh<Scalar> rough_ground(std::uint32_t count, Scalar height, Random& random) {
  return ground<Scalar>(count, [&](Scalar, Scalar) { return height * random.unit<Scalar>(); });
}

template <typename Scalar>
GeneratedMesh<Scalar> smooth_bowl(std::uint32_t count) {
  return ground<Scalar>(
      count, [](Scalar x, Scalar y) { return (x + Scalar{1.5F}) * (x + Scalar{1.5F}) / 2 + (y + 2) * (y + 2) / 3; });
}

template <typename Scalar>
GeneratedMesh<Scalar> line_of_needles(std::size_t count, Random& random) {
  GeneratedMesh<Scalar> mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3<Scalar> a{static_cast<Scalar>(i), random.symmetric<Scalar>(), random.symmetric<Scalar>()};
    const Vector3<Scalar> along{1000, random.symmetric<Scalar>(), random.symmetric<Scalar>()};
    mesh.add({a, a + along, a + in_cube<Scalar>(random)});
  }
  return mesh;
}

template <typename Scalar>
GeneratedMesh<Scalar> dust_in_square(std::size_t count, Random& random) {
  GeneratedMesh<Scalar> mesh;
  const auto add = [&](const Vector3<Scalar>& point) { mesh.add({point, point, point}); };
  add({0, 0, 0});
  add({1, 1, 0});
  for (std::size_t i = 0; i < count; ++i) add({random.unit<Scalar>(), random.unit<Scalar>(), 0});
  return mesh;
}

template <typename Scalar>
GeneratedMesh<Scalar> lattice_cube(std::uint32_t size) {
  GeneratedMesh<Scalar> mesh;
  LatticeVertices id;
  const auto side = static_cast<std::int32_t>(size);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::int32_t height : {0, side}) {
      const auto at = [&](std::int32_t i, std::int32_t j) {
        LatticePoint point;
        point[axis] = height;
        point[(axis + 1) % 3] = i;
        point[(axis + 2) % 3] = j;
        return id(point);
      };
      for (std::int32_t i = 0; i < side; ++i) {
        for (std::int32_t j = 0; j < side; ++j) {
          mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
          mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
      }
    }
  }
  for (const LatticePoint& point : id.points()) mesh.vertices.push_back(vertex<Scalar>(point));
  return mesh;
}

template <typename Scalar>
GeneratedMesh<Scalar> bumpy_octahedron(std::int32_t size, Random& random) {
  GeneratedMesh<Scalar> mesh;
  LatticeVertices id;
  for (int octant = 0; octant < 8; ++octant) {
    const auto at = [&](std::int32_t x, std::int32_t y) {
      const std::int32_t z = size - x - y;
      return id({(octant & 1) != 0 ? -x : x, (octant & 2) != 0 ? -y : y, (octant & 4) != 0 ? -z : z});
    };
    for (std::int32_t x = 0; x < size; ++x) {
      for (std::int32_t y = 0; x + y < size; ++y) {
        mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x, y + 1)});
        if (x + y + 1 < size) mesh.triangles.push_back({at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
      }
    }
  }
  for (const LatticePoint& point : id.points()) {
    mesh.vertices.push_back(vertex<Scalar>(point, static_cast<std::int32_t>(random.between(1000, 1500))));
  }
  return mesh;
}

template <typename Scalar>
GeneratedMesh<Scalar> double_fan(std::int32_t size) {
  GeneratedMesh<Scalar> mesh;
  mesh.vertices = {vertex<Scalar>({0, 0, size}), vertex<Scalar>({0, 0, -size})};
  LatticePoint corner = {size, -size, 0};
  for (const auto& [dx, dy] : {std::array{0, 1}, std::array{-1, 0}, std::array{0, -1}, std::array{1, 0}}) {
    for (std::int32_t i = 0; i < 2 * size; ++i) {
      mesh.vertices.push_back(vertex<Scalar>(corner));
      corner = {corner[0] + dx, corner[1] + dy, 0};
    }
  }
  const auto rim = static_cast<std::uint32_t>(mesh.vertices.size()) - 2;
  for (std::uint32_t i = 0; i < rim; ++i) {
    const std::uint32_t next = (i + 1) % rim;
    mesh.triangles.push_back({0, i + 2, next + 2});
    mesh.triangles.push_back({1, next + 2, i + 2});
  }
  return mesh;
}

template <typename Scalar>
GeneratedMesh<Scalar> placed(GeneratedMesh<Scalar> mesh, Scalar factor, const Vector3<Scalar>& offset) {
  for (Vector3<Scalar>& vertex : mesh.vertices) vertex = vertex * factor + offset;
  return mesh;
}

template <typename Scalar>
GeneratedMesh<Scalar> flattened(GeneratedMesh<Scalar> mesh, int axis, Scalar coordinate) {
  for (Vector3<Scalar>& vertex : mesh.vertices) vertex[axis] = coordinate;
  return mesh;
}

template <typename Scalar>
GeneratedMesh<Scalar> joined(GeneratedMesh<Scalar> mesh, const GeneratedMesh<Scalar>& other) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
  return mesh;
}

template <typename Scalar>
GeneratedMesh<Scalar> grounds_askew(Random& random) {
  const auto ground = [&](Scalar size, Scalar place) {
    return placed<Scalar>(rough_ground<Scalar>(4, Scalar{0.7F}, random), size, {place, 2 * place, -place});
  };
  return joined(joined(ground(Scalar{0.5F}, -2), ground(Scalar{0.25F}, 1)), ground(Scalar{0.125F}, 3));
}

template <typename Scalar>
GeneratedMesh<Scalar> covered_from_a_plane() {
  using Corners = Triangle<Scalar>;
  GeneratedMesh<Scalar> mesh;
  for (const Scalar x : {Scalar{-1}, Scalar{1}}) mesh.add({{x, x, x}, {x, x, x}, {x, x, x}});
  for (const Corners& triangle : std::initializer_list<Corners>{
           {{-0x1.6b5966p-5F, -0x1.911f0ep-5F, -0x1.e63856p-4F},
            {-0x1.0a45c2p-4F, -0x1.fba13cp-6F, -0x1.fbabe8p-4F},
            {-0x1.f205dp-5F, -0x1.3299fp-5F, -0x1.104ffp-3F}},
           {{-0x1.cb3ef4p-4F, 0x1.805ed8p-3F, -0x1.0fca16p-3F},
            {-0x1.06997cp-3F, 0x1.80891p-3F, -0x1.003c2cp-3F},
            {-0x1.eba80ap-4F, 0x1.777d12p-3F, -0x1.47f3eap-3F}},
           {{0x1.5e434ap-3F, 0x1.09080cp-3F, 0x1.4f4d3cp-3F},
            {0x1.2836dap-3F, 0x1.186ed2p-3F, 0x1.0e93cep-3F},
            {0x1.513b3ep-3F, 0x1.4a0088p-3F, 0x1.103b3p-3F}},
           {{-0x1.5130bp-3F, -0x1.5f163cp-3F, -0x1.57a55p-4F},
            {-0x1.46b43ap-3F, -0x1.15906ap-3F, -0x1.3e6892p-4F},
            {-0x1.3f8d6p-3F, -0x1.4aeb7ap-3F, -0x1.187606p-4F}},
           {{-0x1.648d34p-3F, 0x1.2cd03p-5F, -0x1.80f58p-11F},
            {-0x1.6691cap-3F, 0x1.aa1fbcp-5F, -0x1.1ebefcp-6F},
            {-0x1.83ebaep-3F, 0x1.55fbb2p-5F, -0x1.a7bde6p-7F}},
           {{-0x1.a524dcp-7F, -0x1.0284cp-3F, 0x1.3c44cp-4F},
            {0x1.69f36cp-6F, -0x1.078ddcp-3F, 0x1.1a8ad6p-4F},
            {0x1.fbe2bp-9F, -0x1.44a348p-3F, 0x1.130b3cp-4F}},
           {{0x1.638cbp-3F, -0x1.edae16p-5F, -0x1.4f8888p-4F},
            {0x1.51b2fcp-3F, -0x1.3b110cp-4F, -0x1.2cca7p-4F},
            {0x1.216524p-3F, -0x1.ae3d5cp-5F, -0x1.79428ep-4F}},
           {{-0x1.7cff2ep-5F, 0x1.996ep-4F, 0x1.39c238p-3F},
            {-0x1.392d56p-4F, 0x1.512726p-4F, 0x1.4644fap-3F},
            {-0x1.67026cp-5F, 0x1.9cdab4p-4F, 0x1.293d88p-3F}},
           {{0x1.9526ecp-3F, 0x1.e6837p-8F, 0x1.e4a7ccp-5F},
            {0x1.bad85ap-3F, 0x1.ef762ep-6F, 0x1.faa0b6p-5F},
            {0x1.947bb8p-3F, 0x1.d1599cp-6F, 0x1.064bbp-4F}},
       }) {
    mesh.add(triangle);
  }
  return mesh;
}

template <typename Scalar>
GeneratedMesh<Scalar> with_small_copy(const GeneratedMesh<Scalar>& mesh, const Vector3<Scalar>& offset) {
  return joined(mesh, placed(mesh, 1 / Scalar{24}, offset));
}

#define SUREHIT_INSTANTIATE(Scalar)                                                             \
  template struct GeneratedMesh<Scalar>;                                                        \
  template GeneratedMesh<Scalar> scattered_triangles(std::size_t, Scalar, Random&);             \
  template GeneratedMesh<Scalar> rough_ground(std::uint32_t, Scalar, Random&);                  \
  template GeneratedMesh<Scalar> smooth_bowl(std::uint32_t);                                    \
  template GeneratedMesh<Scalar> line_of_needles(std::size_t, Random&);                         \
  template GeneratedMesh<Scalar> dust_in_square(std::size_t, Random&);                          \
  template GeneratedMesh<Scalar> lattice_cube(std::uint32_t);                                   \
  template GeneratedMesh<Scalar> bumpy_octahedron(std::int32_t, Random&);                       \
  template GeneratedMesh<Scalar> double_fan(std::int32_t);                                      \
  template GeneratedMesh<Scalar> placed(GeneratedMesh<Scalar>, Scalar, const Vector3<Scalar>&); \
  template GeneratedMesh<Scalar> flattened(GeneratedMesh<Scalar>, int, Scalar);                 \
  template GeneratedMesh<Scalar> joined(GeneratedMesh<Scalar>, const GeneratedMesh<Scalar>&);   \
  template GeneratedMesh<Scalar> grounds_askew(Random&);                                        \
  template GeneratedMesh<Scalar> covered_from_a_plane();                                        \
  template GeneratedMesh<Scalar> with_small_copy(const GeneratedMesh<Scalar>&, const Vector3<Scalar>&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
