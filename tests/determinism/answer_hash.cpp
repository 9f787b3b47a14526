#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "answers.hpp"
#include "hard_prop.hpp"
#include "hard_questions.hpp"
#include "hard_scene.hpp"
#include "hard_scene_shapes.hpp"
#include "hard_shapes.hpp"
#include "saved_hash.hpp"

namespace {

/// Prints the hash of the answers; whether it is the published one.
bool is_published(const char* name, std::uint64_t hash, std::uint64_t published) {
  std::printf("%s: %016" PRIx64 ", %s\n", name, hash, hash == published ? "as published" : "NOT THE PUBLISHED ONE");
  return hash == published;
}

template <typename Scalar>
bool answers_are_published(const char* name, bool few) {
  surehit::test::HardQuestions<Scalar> hard;
  if (few) surehit::test::keep_few(hard.questions.all);
  const surehit::Collider<Scalar> collider = hard.collider();
  const std::uint64_t hash = surehit::test::Answers<Scalar>(collider, hard.questions).hash();
  const std::uint64_t saved = surehit::test::saved_hash(collider);
  const bool is_saved = is_published("its bytes", saved, surehit::test::published_saved_hash<Scalar>);
  const std::uint64_t published =
      few ? surehit::test::published_hash_of_few<Scalar> : surehit::test::published_hash<Scalar>;
  return is_published(name, hash, published) && is_saved;
}

template <typename Scalar>
bool prop_answers_are_published(const char* name) {
  const surehit::test::HardProp<Scalar> hard;
  const surehit::Collider<Scalar> collider = hard.collider();
  const std::uint64_t hash = surehit::test::Answers<Scalar>(collider, hard.questions).hash();
  const std::uint64_t saved = surehit::test::saved_hash(collider);
  const bool is_saved = is_published("its bytes", saved, surehit::test::published_saved_prop_hash<Scalar>);
  return is_published(name, hash, surehit::test::published_prop_hash<Scalar>) && is_saved;
}

template <typename Scalar>
bool scene_answers_are_published(const char* name, bool few) {
  surehit::test::HardScene<Scalar> hard;
  if (few) surehit::test::keep_few(hard.paths);
  const surehit::Scene<Scalar> scene = hard.scene();
  const std::uint64_t hash = surehit::test::SceneAnswers<Scalar>(scene, hard.paths).hash();
  const std::uint64_t saved = surehit::test::saved_hash(scene);
  const bool is_saved = is_published("its bytes", saved, surehit::test::published_saved_scene_hash<Scalar>);
  const std::uint64_t published =
      few ? surehit::test::published_scene_hash_of_few<Scalar> : surehit::test::published_scene_hash<Scalar>;
  return is_published(name, hash, published) && is_saved;
}

template <typename Scalar>
bool shape_answers_are_published(const char* name, bool few) {
  surehit::test::HardShapes<Scalar> hard;
  if (few) surehit::test::keep_few(hard.shapes);
  const std::uint64_t hash = surehit::test::ShapeAnswers<Scalar>(hard.hard.collider(), hard.shapes).hash();
  const std::uint64_t contacts = surehit::test::ShapeContacts<Scalar>(hard.hard.collider(), hard.shapes).hash();
  const bool are_contacts = is_published("their contacts", contacts,
                                         few ? surehit::test::published_shape_contact_hash_of_few<Scalar>
                                             : surehit::test::published_shape_contact_hash<Scalar>);
  const bool are_hits = is_published(
      name, hash,
      few ? surehit::test::published_shape_hash_of_few<Scalar> : surehit::test::published_shape_hash<Scalar>);
  return are_hits && are_contacts;
}

template <typename Scalar>
bool scene_shape_answers_are_published(const char* name, bool few) {
  surehit::test::HardSceneShapes<Scalar> hard;
  if (few) surehit::test::keep_few(hard.shapes);
  const std::uint64_t hash = surehit::test::SceneShapeAnswers<Scalar>(hard.hard.scene(), hard.shapes).hash();
  return is_published(name, hash,
                      few ? surehit::test::published_scene_shape_hash_of_few<Scalar>
                          : surehit::test::published_scene_shape_hash<Scalar>);
}

}  // namespace

/// Hashes what a library answers that somebody else has compiled: to the hard questions, and about the hard prop,
/// scene, shapes, and shapes in the scene. The bytes of all but the shapes are hashed too. With `--few`, where nothing
/// is optimized, it asks a sixteenth of all but the prop's questions.
int main(int argc, char** argv) {
  const bool few = argc == 2 && std::string_view(argv[1]) == "--few";
  if (argc > 1 && !few) {
    std::fprintf(stderr, "usage: answer_hash [--few]\n");
    return 2;
  }
  const bool floats = answers_are_published<float>("float", few);
  const bool doubles = answers_are_published<double>("double", few);
  const bool float_props = prop_answers_are_published<float>("prop of floats");
  const bool double_props = prop_answers_are_published<double>("prop of doubles");
  const bool float_scenes = scene_answers_are_published<float>("scene of floats", few);
  const bool double_scenes = scene_answers_are_published<double>("scene of doubles", few);
  const bool float_shapes = shape_answers_are_published<float>("shapes of floats", few);
  const bool double_shapes = shape_answers_are_published<double>("shapes of doubles", few);
  const bool float_scene_shapes = scene_shape_answers_are_published<float>("shapes in a scene of floats", few);
  const bool double_scene_shapes = scene_shape_answers_are_published<double>("shapes in a scene of doubles", few);
  const bool props = float_props && double_props;
  const bool shapes = float_shapes && double_shapes && float_scene_shapes && double_scene_shapes;
  return floats && doubles && props && float_scenes && double_scenes && shapes ? 0 : 1;
}
