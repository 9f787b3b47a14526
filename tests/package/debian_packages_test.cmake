# Debian packages are made and installed into a root of their own, where README's example is built against them: by
# CMake and by pkg-config. Then two versions are installed side by side.
include("${CMAKE_CURRENT_LIST_DIR}/consumer_project.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/shared_library_checks.cmake")

file(REMOVE_RECURSE "${TEST_FOLDER}")
copy_library_sources("${TEST_FOLDER}/surehit")
file(COPY "${SOURCE_FOLDER}/LICENSE" DESTINATION "${TEST_FOLDER}/surehit")

function(configure_library)
  run("${CMAKE_COMMAND}" -S "${TEST_FOLDER}/surehit" -B "${TEST_FOLDER}/build" -G "${GENERATOR}"
    "-DCMAKE_CXX_COMPILER=${LIBRARY_COMPILER}" -DCMAKE_BUILD_TYPE=None "-DCMAKE_CXX_FLAGS=${FLAGS} ${MORE_FLAGS}"
    -DBUILD_SHARED_LIBS=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_INSTALL_PREFIX=/usr -DSUREHIT_OPTIMIZED=OFF
    -DSUREHIT_WARNINGS_AS_ERRORS=ON -DSUREHIT_BUILD_TESTS=OFF -DSUREHIT_BUILD_EXAMPLES=OFF -DCMAKE_DISABLE_FIND_PACKAGE_Doxygen=ON ${ARGV})
  run("${CMAKE_COMMAND}" --build "${TEST_FOLDER}/build" --parallel 1)
endfunction()

# Sets a variable to what a command prints.
function(output_of variable)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(${variable} "${output}" PARENT_SCOPE)
endfunction()

function(expect_match text pattern)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "no match of ${pattern} in:\n${text}")
  endif()
endfunction()

configure_library()
file(STRINGS "${TEST_FOLDER}/build/CMakeCache.txt" version REGEX "^CMAKE_PROJECT_VERSION:")
string(REGEX REPLACE ".*=" "" version "${version}")
string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" interface_version "${version}")
set(library_package libsurehit${CMAKE_MATCH_1})

set(packages "${TEST_FOLDER}/packages")
cmake_path(GET CMAKE_COMMAND PARENT_PATH tools)
foreach(kind IN ITEMS DEB TGZ)
  run("${tools}/cpack" -G ${kind} --config "${TEST_FOLDER}/build/CPackConfig.cmake" -B "${packages}")
endforeach()
output_of(architecture dpkg --print-architecture)
set(library_deb "${packages}/${library_package}_${version}_${architecture}.deb")
set(development_deb "${packages}/libsurehit-dev_${version}_${architecture}.deb")

# What the packages say of themselves.
output_of(multiarch "${COMPILER}" -print-multiarch)
output_of(listing dpkg-deb --contents "${library_deb}")
expect_match("${listing}" "\\./usr/lib/${multiarch}/libsurehit\\.so\\.${interface_version} -> libsurehit\\.so\\.${version}")
expect_match("${listing}" "\\./usr/share/doc/${library_package}/copyright")
output_of(said dpkg-deb --field "${library_deb}")
expect_match("${said}" "Depends: [^\n]*libc6 \\(>= ")
expect_match("${said}" "Section: libs\n")
output_of(said dpkg-deb --info "${library_deb}" shlibs)
expect_match("${said}" "^libsurehit ${interface_version} ${library_package} \\(>= ${interface_version}\\), ${library_package} \\(<< [0-9.]+\\)$")
output_of(said dpkg-deb --field "${development_deb}")
expect_match("${said}" "Depends: [^\n]*libeigen3-dev \\(>= 3.4\\)")
expect_match("${said}" "Depends: [^\n]*${library_package} \\(= ${version}\\)")
output_of(listing dpkg-deb --contents "${development_deb}")
foreach(file IN ITEMS "include/surehit/surehit\\.hpp" "lib/${multiarch}/libsurehit\\.so -> libsurehit\\.so\\.${interface_version}"
    "lib/${multiarch}/pkgconfig/surehit\\.pc" "lib/${multiarch}/cmake/surehit/surehit-config\\.cmake"
    "share/doc/libsurehit-dev/copyright")
  expect_match("${listing}" "\\./usr/${file}")
endforeach()

# They are installed. The new root knows the packages of this machine, so dpkg checks what ours depend on. It has no
# shell, so the packages' scripts run outside, with an ldconfig that only notes that it was called.
file(WRITE "${TEST_FOLDER}/bin/ldconfig" "#!/bin/sh\ntouch \"\$DPKG_ROOT/ldconfig_was_called\"\n")
file(CHMOD "${TEST_FOLDER}/bin/ldconfig" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
set(ENV{PATH} "${TEST_FOLDER}/bin:$ENV{PATH}:/usr/sbin:/sbin")
set(root "${TEST_FOLDER}/root")
set(dpkg dpkg "--root=${root}" --no-triggers --force-script-chrootless "--log=${TEST_FOLDER}/dpkg.log")
file(MAKE_DIRECTORY "${root}/var/lib/dpkg/info" "${root}/var/lib/dpkg/updates" "${root}/var/lib/dpkg/triggers")
file(COPY /var/lib/dpkg/status DESTINATION "${root}/var/lib/dpkg")
output_of(user id -u)
if(NOT user EQUAL 0)
  list(PREPEND dpkg "${FAKEROOT}")
endif()
run(${dpkg} --install "${library_deb}" "${development_deb}")
output_of(said dpkg-query "--admindir=${root}/var/lib/dpkg" --show "--showformat=\${db:Status-Status}" libsurehit-dev)
expect_match("${said}" "^installed$")
if(NOT EXISTS "${root}/ldconfig_was_called")
  message(FATAL_ERROR "nobody has told the loader of the new library")
endif()
file(STRINGS "${root}/usr/share/doc/${library_package}/copyright" said REGEX "^(License: Expat|Copyright: [0-9]+ |Format: )")
list(LENGTH said count)
if(NOT count EQUAL 4)
  message(FATAL_ERROR "the copyright file is not as Debian wants it: ${said}")
endif()
output_of(said objdump --private-headers "${root}/usr/lib/${multiarch}/libsurehit.so")
expect_match("${said}" "SONAME +libsurehit\\.so\\.${interface_version}\n")
check_exports("${root}/usr/lib/${multiarch}/libsurehit.so")
if(CSHARP_COMPILER)
  check_csharp_program("${root}/usr/lib/${multiarch}")
endif()

# Whoever uses the installed packages gets the published answers.
set(ENV{LD_LIBRARY_PATH} "${root}/usr/lib/${multiarch}")
set(BUILD_TYPE None)
set(TEST_FOLDER_OF_LIBRARY "${TEST_FOLDER}")
set(TEST_FOLDER "${TEST_FOLDER}/user")
configure_consumer("-DCMAKE_PREFIX_PATH=${root}/usr" "-DCMAKE_LIBRARY_ARCHITECTURE=${multiarch}" -DCMAKE_DISABLE_FIND_PACKAGE_hwy=ON)
build_and_run_consumer(--few)
set(TEST_FOLDER "${TEST_FOLDER_OF_LIBRARY}")

# The example of the README, and what it prints.
file(READ "${SOURCE_FOLDER}/README.md" readme)
string(REGEX MATCH "\n## A first hit\n\n```cpp\n(.*)" ignored "${readme}")
string(FIND "${CMAKE_MATCH_1}" "\n```\n\n```text\n" end)
string(SUBSTRING "${CMAKE_MATCH_1}" 0 ${end} example)
string(SUBSTRING "${CMAKE_MATCH_1}" ${end} 200 printed)
string(REGEX MATCH "```text\n([^`]+)\n```" ignored "${printed}")
set(printed "${CMAKE_MATCH_1}")
file(MAKE_DIRECTORY "${TEST_FOLDER}/game")
file(CONFIGURE OUTPUT "${TEST_FOLDER}/game/main.cpp" CONTENT "${example}\n" @ONLY)
file(WRITE "${TEST_FOLDER}/game/CMakeLists.txt" "cmake_minimum_required(VERSION 3.25)
project(game LANGUAGES CXX)
find_package(surehit ${interface_version} REQUIRED)
add_executable(game main.cpp)
target_link_libraries(game PRIVATE surehit::surehit)
")
run("${CMAKE_COMMAND}" -S "${TEST_FOLDER}/game" -B "${TEST_FOLDER}/game/build" -G "${GENERATOR}"
  "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_PREFIX_PATH=${root}/usr" "-DCMAKE_LIBRARY_ARCHITECTURE=${multiarch}"
  -DCMAKE_DISABLE_FIND_PACKAGE_hwy=ON)
file(STRINGS "${TEST_FOLDER}/game/build/CMakeCache.txt" found REGEX "^surehit_DIR:")
expect_match("${found}" "=${root}/usr/")
run("${CMAKE_COMMAND}" --build "${TEST_FOLDER}/game/build")
output_of(said "${TEST_FOLDER}/game/build/game")
expect_match("${said}" "^${printed}$")
if(PKG_CONFIG)
  output_of(flags "${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${root}/usr/lib/${multiarch}/pkgconfig"
    "${PKG_CONFIG}" --cflags --libs surehit)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run("${COMPILER}" -std=c++20 "${TEST_FOLDER}/game/main.cpp" -o "${TEST_FOLDER}/game/by_pkg_config" ${flags})
  output_of(said "${TEST_FOLDER}/game/by_pkg_config")
  expect_match("${said}" "^${printed}$")
endif()

# What is removed leaves nothing, and the archive has the same files.
run(${dpkg} --purge libsurehit-dev ${library_package})
file(GLOB_RECURSE left "${root}/usr/*")
if(left)
  message(FATAL_ERROR "after the packages are removed, these are left: ${left}")
endif()
file(GLOB archive "${packages}/surehit-${version}-*.tar.gz")
output_of(listing "${CMAKE_COMMAND}" -E tar tf "${archive}")
expect_match("${listing}" "/lib/${multiarch}/libsurehit\\.so\\.${version}\n")
expect_match("${listing}" "/include/surehit/surehit\\.hpp\n")

# Two versions in one place: each project gets the one that it asks for.
set(version_header "${TEST_FOLDER}/surehit/collision/include/surehit/c/version.h")
file(READ "${version_header}" content)
string(REGEX MATCH "SUREHIT_VERSION_MINOR ([0-9]+)" ignored "${content}")
set(minor ${CMAKE_MATCH_1})
math(EXPR next_minor "${minor} + 1")
configure_library(-DSUREHIT_VERSIONED_INSTALL=ON)
run("${CMAKE_COMMAND}" --install "${TEST_FOLDER}/build" --prefix "${TEST_FOLDER}/both")
string(REPLACE "SUREHIT_VERSION_MINOR ${minor}" "SUREHIT_VERSION_MINOR ${next_minor}" content "${content}")
file(WRITE "${version_header}" "${content}")
configure_library(-DSUREHIT_VERSIONED_INSTALL=ON)
run("${CMAKE_COMMAND}" --install "${TEST_FOLDER}/build" --prefix "${TEST_FOLDER}/both")
string(REGEX REPLACE "[0-9]+$" "${next_minor}" next_version "${interface_version}")

file(WRITE "${TEST_FOLDER}/game/main.cpp" "#include <cstdio>\n#include <surehit/surehit.hpp>
int main() {
  const surehit::Trianglef triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const bool is_hit = surehit::intersect(surehit::Segmentf{{1, 1, 1}, {1, 1, -1}}, triangle).has_value();
  std::printf(\"%d.%d %d\\n\", SUREHIT_VERSION_MAJOR, SUREHIT_VERSION_MINOR, is_hit ? 1 : 0);
}
")
set(ENV{LD_LIBRARY_PATH} "${TEST_FOLDER}/both/lib/${multiarch}")
foreach(version IN ITEMS ${interface_version} ${next_version})
  file(READ "${TEST_FOLDER}/game/CMakeLists.txt" lists)
  string(REGEX REPLACE "find_package\\(surehit [0-9.]+" "find_package(surehit ${version}" lists "${lists}")
  file(WRITE "${TEST_FOLDER}/game/CMakeLists.txt" "${lists}")
  run("${CMAKE_COMMAND}" -S "${TEST_FOLDER}/game" -B "${TEST_FOLDER}/game/with_${version}" -G "${GENERATOR}"
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_PREFIX_PATH=${TEST_FOLDER}/both" "-DCMAKE_LIBRARY_ARCHITECTURE=${multiarch}")
  run("${CMAKE_COMMAND}" --build "${TEST_FOLDER}/game/with_${version}")
  output_of(said "${TEST_FOLDER}/game/with_${version}/game")
  expect_match("${said}" "^${version} 1$")
  output_of(said objdump --private-headers "${TEST_FOLDER}/game/with_${version}/game")
  expect_match("${said}" "NEEDED +libsurehit-${version}\\.so\\.${version}\n")
  if(PKG_CONFIG)
    output_of(said "${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${TEST_FOLDER}/both/lib/${multiarch}/pkgconfig"
      "${PKG_CONFIG}" --libs surehit-${version})
    expect_match("${said}" "-lsurehit-${version}( |$)")
  endif()
endforeach()
