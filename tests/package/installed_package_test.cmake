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

configure_consumer("-DCMAKE_PREFIX_PATH=${TEST_FOLDER}/moved")
build_and_run_consumer()
