# Configures, builds and tests project/ in a folder of its own. The test fails if one of its programs does.
separate_arguments(OPTIONS)
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/project" -B "${TEST_FOLDER}" -G "${GENERATOR}"
  -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS=${FLAGS}" ${OPTIONS})
run("${CMAKE_COMMAND}" --build "${TEST_FOLDER}" --parallel ${PARALLEL})
# Wine keeps its settings in a folder, which it makes.
set(ENV{WINEPREFIX} "${TEST_FOLDER}/wine")
set(ENV{WINEDEBUG} "-all")
cmake_path(GET CMAKE_COMMAND PARENT_PATH tools)
run("${tools}/ctest" --test-dir "${TEST_FOLDER}" --output-on-failure --no-tests=error)
