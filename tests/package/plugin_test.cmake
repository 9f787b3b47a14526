# A plugin that holds a static copy of the library links, works by pkg-config's flags, and shows nobody that copy. A program
# in C links by the same flags.
include("${CMAKE_CURRENT_LIST_DIR}/consumer_project.cmake")

file(REMOVE_RECURSE "${TEST_FOLDER}")
run("${CMAKE_COMMAND}" --install "${BUILD_FOLDER}" --prefix "${TEST_FOLDER}/installed")
file(GLOB_RECURSE pc_file "${TEST_FOLDER}/installed/*/surehit.pc")
get_filename_component(pc_folder "${pc_file}" DIRECTORY)
execute_process(COMMAND "${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${pc_folder}" "${PKG_CONFIG}" --cflags --libs --static surehit
  OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")

# Wherever the libraries go, pkg-config finds the prefix.
foreach(library_folder IN ITEMS lib lib/x86_64-linux-gnu "${TEST_FOLDER}/elsewhere")
  run("${CMAKE_COMMAND}" -S "${SOURCE_FOLDER}" -B "${TEST_FOLDER}/configured" -G "${GENERATOR}"
    "-DCMAKE_CXX_COMPILER=${COMPILER}" -DSUREHIT_BUILD_TESTS=OFF -DSUREHIT_BUILD_EXAMPLES=OFF
    "-DCMAKE_INSTALL_PREFIX=${TEST_FOLDER}/prefix" "-DCMAKE_INSTALL_LIBDIR=${library_folder}")
  cmake_path(ABSOLUTE_PATH library_folder BASE_DIRECTORY "${TEST_FOLDER}/prefix" OUTPUT_VARIABLE expected)
  file(COPY "${TEST_FOLDER}/configured/surehit.pc" DESTINATION "${expected}/pkgconfig")
  foreach(variable IN ITEMS libdir includedir)
    execute_process(COMMAND "${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${expected}/pkgconfig"
      "${PKG_CONFIG}" "--variable=${variable}" surehit
      OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    cmake_path(NORMAL_PATH found)
    if(variable STREQUAL includedir)
      set(expected "${TEST_FOLDER}/prefix/include")
    endif()
    if(NOT found STREQUAL expected)
      message(FATAL_ERROR "with libraries in ${library_folder}, ${variable} is ${found} and not ${expected}")
    endif()
  endforeach()
endforeach()

file(WRITE "${TEST_FOLDER}/plugin.cpp" "#include <surehit/surehit.hpp>
extern \"C\" __attribute__((visibility(\"default\"))) int hits() {
  const float vertices[] = {0, 0, 0, 4, 0, 0, 0, 4, 0};
  const int triangle[] = {0, 1, 2};
  const surehit::Colliderf collider(surehit::TriangleMeshViewf(vertices, triangle));
  return collider.any_hit(surehit::Segmentf{{1, 1, 1}, {1, 1, -1}}) ? 1 : 0;
}
")
file(WRITE "${TEST_FOLDER}/host.cpp" "extern \"C\" int hits();\nint main() { return hits() == 1 ? 0 : 1; }\n")
run("${COMPILER}" -std=c++20 -fPIC -shared -fvisibility=hidden -fvisibility-inlines-hidden "${TEST_FOLDER}/plugin.cpp"
  -o "${TEST_FOLDER}/libplugin.so" ${flags})
run("${COMPILER}" "${TEST_FOLDER}/host.cpp" -o "${TEST_FOLDER}/host" "${TEST_FOLDER}/libplugin.so" ${flags})
run("${CMAKE_COMMAND}" -E env "LD_LIBRARY_PATH=${TEST_FOLDER}" "${TEST_FOLDER}/host")

execute_process(COMMAND "${NM}" --dynamic --defined-only --demangle "${TEST_FOLDER}/libplugin.so"
  OUTPUT_VARIABLE exported COMMAND_ERROR_IS_FATAL ANY)
if(NOT exported MATCHES " hits" OR exported MATCHES "[^\n]*surehit(::|_)[^\n]*")
  message(FATAL_ERROR "the plugin exports ${CMAKE_MATCH_0} of:\n${exported}")
endif()

# A program in C needs no more flags, and no C++ compiler.
run("${C_COMPILER}" -std=c99 "${SOURCE_FOLDER}/tests/collision/c/c99_collider_test.c" -o "${TEST_FOLDER}/c_program" ${flags})
run("${TEST_FOLDER}/c_program")
