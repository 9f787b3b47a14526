# How the tests of this folder configure, build and run the project in consumer/.

# Runs a command and fails the test if the command does.
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# A copy of what an embedding project needs, and nothing else: neither the tests nor the examples are there to be built.
function(copy_library_sources to)
  file(COPY "${SOURCE_FOLDER}/CMakeLists.txt" "${SOURCE_FOLDER}/broadphase" "${SOURCE_FOLDER}/collision" DESTINATION "${to}")
endfunction()

function(configure_consumer)
  run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/consumer" -B "${TEST_FOLDER}/build" -G "${GENERATOR}"
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}" "-DCMAKE_CXX_FLAGS=${FLAGS} ${MORE_FLAGS}"
    ${ARGV})
endfunction()

# The arguments are those of answer_hash.
function(build_and_run_consumer)
  run("${CMAKE_COMMAND}" --build "${TEST_FOLDER}/build" --parallel 1)
  run("${TEST_FOLDER}/build/consumer")
  run("${TEST_FOLDER}/build/answer_hash" ${ARGV})
  if(EXISTS "${TEST_FOLDER}/build/gpu_consumer")
    run("${TEST_FOLDER}/build/gpu_consumer")
  endif()
endfunction()
