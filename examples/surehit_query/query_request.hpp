#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <surehit/path.hpp>
#include <surehit/query_options.hpp>
#include <vector>

namespace surehit::example {

enum class Question : std::uint8_t { pair, first, any, all, explain, bake };

enum class ScalarKind : std::uint8_t { single_precision, double_precision };

/// What a path is: a straight one, or a shape that moves.
enum class PathForm : std::uint8_t { segment, ray, line, sphere, box, capsule };

[[nodiscard]] constexpr bool is_shape(PathForm form) { return form >= PathForm::sphere; }

/// What the ids in the output count: the triangles, or the faces that the file's triangles were cut from.
enum class IdKind : std::uint8_t { triangle, face };

/// What the command line asks for. Limits of t stay texts until it is known what they are rounded to.
struct QueryRequest {
  Question question = Question::pair;
  std::string mesh_path;   ///< none for `pair`, and none for a scene
  std::string scene_path;  ///< none where empty
  std::string input_path;
  std::string output_path = "-";
  ScalarKind scalar = ScalarKind::single_precision;
  PathForm path = PathForm::segment;
  std::size_t threads = 1;

  std::string min_t = "-inf";
  std::string max_t = "inf";
  Culling culling = Culling::none;
  bool ignore_start_contact = false;
  bool ignore_end_contact = false;

  // These narrow a mesh or a scene, so `pair` has none of them. The mask is that of instances in a scene.
  std::uint32_t mask = ~std::uint32_t{0};
  std::string masks_path;  ///< none where empty
  std::optional<std::uint32_t> ignored_instance;
  std::optional<std::uint32_t> ignored_triangle;  ///< in a scene, of the ignored instance
  std::optional<std::uint32_t> ignored_face;

  IdKind ids = IdKind::triangle;
  bool wants_points = false;
  bool wants_normals = false;
  bool wants_free_points = false;  ///< of `first` alone
  bool wants_statistics = false;   ///< none of `pair`
  bool uses_gpu = false;           ///< of `first` and `any` alone
  std::string gpu_name;            ///< any that is no software where empty

  std::optional<std::size_t> index;   ///< of `explain` alone: which path of the input
  std::vector<std::string> drawings;  ///< of `explain` alone: the files to draw to
};

}  // namespace surehit::example
