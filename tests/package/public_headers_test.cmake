# What a user includes shows no internal type, and draws no warning though it is no system header.
file(REMOVE_RECURSE "${TEST_FOLDER}")
file(MAKE_DIRECTORY "${TEST_FOLDER}")
set(include_flags "-I${SOURCE_FOLDER}/broadphase/include" "-I${SOURCE_FOLDER}/collision/include"
  -isystem "${EIGEN_FOLDER}" -std=c++20)

file(WRITE "${TEST_FOLDER}/user.cpp" "#include <vector>
#include <surehit/surehit.hpp>
template struct surehit::BatchOptions<float>;
template <typename Scalar>
bool ask() {
  const std::vector<surehit::Vector3<Scalar>> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<int> triangles = {0, 1, 2};
  surehit::Collider<Scalar> collider(surehit::TriangleMeshView<Scalar>(points, triangles));
  const std::vector<surehit::Segment<Scalar>> segments(2);
  std::vector<surehit::Hit<Scalar>> hits(2);
  const auto filter = [](std::size_t path, const surehit::Hit<Scalar>& hit) { return path == 0 || hit.u > 0; };
  const auto tasks = [](std::size_t count, const surehit::Executor::Task& task) { while (count > 0) task(--count); };
  collider.first_hits(segments, hits, {.filter = filter, .executor = tasks});
  collider.first_hits(surehit::PathSpan<Scalar>::rays(points, points), hits, {.filter = [](const surehit::Hit<Scalar>& hit) { return hit.v > 0; }});
  collider.rebuild(points);
  const auto hit = collider.first_hit(segments[0], [](const surehit::Hit<Scalar>& one) { return one.t > 0; });
  return hit && surehit::distance(segments[0], *hit) > 0 && surehit::intersect(segments[0], collider.triangle(0)).has_value();
}
int main() { return ask<float>() || ask<double>() ? 0 : 1; }
")
execute_process(COMMAND "${COMPILER}" ${include_flags} -E -P -DNDEBUG "${TEST_FOLDER}/user.cpp"  # without the paths of headers
  OUTPUT_VARIABLE preprocessed COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE internal_headers RELATIVE "${SOURCE_FOLDER}"
  "${SOURCE_FOLDER}/broadphase/src/*.hpp" "${SOURCE_FOLDER}/collision/src/*.hpp")
foreach(header IN LISTS internal_headers)
  file(STRINGS "${SOURCE_FOLDER}/${header}" definitions REGEX "^(struct|class|enum class) [A-Za-z0-9_]+.*{$")
  foreach(definition IN LISTS definitions)
    string(REGEX MATCH "^(struct|class|enum class) (alignas\\(.*\\) )?([A-Za-z0-9_]+)" ignored "${definition}")
    set(type "${CMAKE_MATCH_3}")
    if(type MATCHES "^((Collider|Scene)State|CommittedScene)$")  # which the headers name, and nothing more
      continue()
    endif()
    if(preprocessed MATCHES "[^A-Za-z0-9_]${type}[^A-Za-z0-9_]")
      message(FATAL_ERROR "users see ${type} of ${header}")
    endif()
    math(EXPR checked "${checked} + 1")
  endforeach()
endforeach()
if(checked LESS 40)
  message(FATAL_ERROR "only ${checked} internal types were found")
endif()

foreach(compiler IN LISTS COMPILER OTHER_COMPILER)
  if(compiler)
    execute_process(COMMAND "${compiler}" ${include_flags} -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror
      -fsyntax-only "${TEST_FOLDER}/user.cpp" COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()

# Clang warns of views of containers that end before them, and not of views of spans.
if(OTHER_COMPILER)
  file(WRITE "${TEST_FOLDER}/lifetimes.cpp" "#include <vector>
#include <surehit/surehit.hpp>
using namespace surehit;
VertexViewf points() { std::vector<Vector3f> local(3); return local; }
TriangleIndexView triangles() { std::vector<int> local(3); return local; }
PathSpanf paths() { std::vector<Rayf> local(3); return local; }
HitFilterf filter() { auto local = [](const Hitf&) { return true; }; const auto& named = local; return named; }
Executor executor() { auto local = [](std::size_t count, const Executor::Task& task) { if (count > 0) task(0); }; const auto& named = local; return named; }
HitFilterf same_filter() { return [](const Hitf& hit) { return hit.t > 0; }; }
VertexViewf same_points(std::span<const Vector3f> points) { return points; }
VertexViewf same_points(const float* points, int count) { return Eigen::Map<const Eigen::Matrix3Xf>(points, 3, count); }
PathSpanf same_paths(std::span<const Segmentf> paths) { return paths; }
TriangleMeshViewf same_mesh(std::span<const Vector3f> points, std::span<const int> triangles) { return {points, triangles}; }
")
  execute_process(COMMAND "${OTHER_COMPILER}" ${include_flags} -fsyntax-only "${TEST_FOLDER}/lifetimes.cpp"
    OUTPUT_VARIABLE warnings ERROR_VARIABLE warnings COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "local variable 'local' returned" of_containers "${warnings}")
  string(REGEX MATCHALL "warning:" all "${warnings}")
  list(LENGTH of_containers of_containers)
  list(LENGTH all all)
  if(NOT of_containers EQUAL 5 OR NOT all EQUAL 5)
    message(FATAL_ERROR "Clang warns ${all} times, of containers ${of_containers} times, instead of 5 times:\n${warnings}")
  endif()
endif()

# Before C++20 there is one error, which says what is needed.
list(REMOVE_ITEM include_flags -std=c++20)
file(WRITE "${TEST_FOLDER}/old.cpp" "#include <surehit/surehit.hpp>\n")
execute_process(COMMAND "${COMPILER}" ${include_flags} -std=c++17 -fsyntax-only "${TEST_FOLDER}/old.cpp"
  RESULT_VARIABLE result ERROR_VARIABLE errors OUTPUT_VARIABLE errors)
string(REGEX MATCHALL "error:" count "${errors}")
list(LENGTH count count)
if(result EQUAL 0 OR NOT errors MATCHES "surehit needs C\\+\\+20" OR NOT count EQUAL 1)
  message(FATAL_ERROR "C++17 draws ${count} errors:\n${errors}")
endif()

# So does a number type that there is no collider of.
file(WRITE "${TEST_FOLDER}/integers.cpp" "#include <surehit/surehit.hpp>\nsurehit::Collider<int> collider;\n")
execute_process(COMMAND "${COMPILER}" ${include_flags} -std=c++20 -fsyntax-only "${TEST_FOLDER}/integers.cpp"
  RESULT_VARIABLE result ERROR_VARIABLE errors OUTPUT_VARIABLE errors)
if(result EQUAL 0 OR NOT errors MATCHES "FloatOrDouble")
  message(FATAL_ERROR "Collider<int> is not refused by FloatOrDouble:\n${errors}")
endif()
