# A project that embeds the sources by FetchContent builds and works, and installs nothing of surehit's.
include("${CMAKE_CURRENT_LIST_DIR}/consumer_project.cmake")

file(REMOVE_RECURSE "${TEST_FOLDER}")
copy_library_sources("${TEST_FOLDER}/surehit")
separate_arguments(OPTIONS)
configure_consumer("-DSUREHIT_SOURCE_FOLDER=${TEST_FOLDER}/surehit" ${OPTIONS})
build_and_run_consumer()

run("${CMAKE_COMMAND}" --install "${TEST_FOLDER}/build" --prefix "${TEST_FOLDER}/installed")
file(GLOB_RECURSE installed RELATIVE "${TEST_FOLDER}/installed" "${TEST_FOLDER}/installed/*")
if(NOT installed STREQUAL "bin/consumer")
  message(FATAL_ERROR "the embedding project installs more than its own program: ${installed}")
endif()
