# An installed copy, moved to another folder, is found by find_package and works.
include("${CMAKE_CURRENT_LIST_DIR}/consumer_project.cmake")

file(REMOVE_RECURSE "${TEST_FOLDER}")
run("${CMAKE_COMMAND}" --install "${BUILD_FOLDER}" --prefix "${TEST_FOLDER}/installed")
file(RENAME "${TEST_FOLDER}/installed" "${TEST_FOLDER}/moved")

file(GLOB_RECURSE package_files "${TEST_FOLDER}/moved/*.cmake")
foreach(file IN LISTS package_files)
  file(READ "${file}" content)
  foreach(folder IN ITEMS "${SOURCE_FOLDER}" "${BUILD_FOLDER}")
    string(FIND "${content}" "${folder}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} is bound to ${folder}")
    endif()
  endforeach()
endforeach()

# The tests of determinism ask all questions of this library.
configure_consumer("-DCMAKE_PREFIX_PATH=${TEST_FOLDER}/moved")
build_and_run_consumer(--few)

# So does a project in C, which has no C++ compiler.
run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/c_consumer" -B "${TEST_FOLDER}/c_build" -G "${GENERATOR}"
  "-DCMAKE_C_COMPILER=${C_COMPILER}" "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}" "-DCMAKE_PREFIX_PATH=${TEST_FOLDER}/moved")
run("${CMAKE_COMMAND}" --build "${TEST_FOLDER}/c_build" --parallel 1)
run("${TEST_FOLDER}/c_build/c_consumer")
