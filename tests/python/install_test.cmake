# pip installs the package without a network, for the tests that ask it. It builds the library by CMake, or takes the
# one that it is told to take, but none that is no surehit.
#
# The project around the package is a stand-in that builds nothing, and hands over a library. The tests of package/
# build the real one as a shared library.
set(tree "${FOLDER}/tree")
set(package "${tree}/collision/bindings/python")
file(REMOVE_RECURSE "${tree}" "${TO}")
file(COPY "${PACKAGE}/" DESTINATION "${package}" PATTERN build EXCLUDE PATTERN "*.egg-info" EXCLUDE)
file(COPY "${SOURCE_FOLDER}/collision/include/surehit/c/version.h" DESTINATION "${tree}/collision/include/surehit/c")
file(CONFIGURE OUTPUT "${tree}/CMakeLists.txt" @ONLY CONTENT [[
cmake_minimum_required(VERSION 3.25)
project(stand_in LANGUAGES NONE)
if(NOT BUILD_SHARED_LIBS OR NOT CMAKE_BUILD_TYPE STREQUAL Release OR NOT TOLD STREQUAL "two words"
   OR NOT DEFINED SUREHIT_BUILD_TESTS OR SUREHIT_BUILD_TESTS
   OR NOT DEFINED SUREHIT_BUILD_EXAMPLES OR SUREHIT_BUILD_EXAMPLES)
  message(FATAL_ERROR "the package is built with other options")
endif()
add_custom_target(surehit_collision
  COMMAND "${CMAKE_COMMAND}" -E copy "@LIBRARY@" "${CMAKE_BINARY_DIR}/collision/@NAME@")
]])

function(install library result)
  set(variables --unset=SUREHIT_LIBRARY)
  if(library)
    set(variables "SUREHIT_LIBRARY=${library}")
  endif()
  execute_process(COMMAND "${CMAKE_COMMAND}" -E env ${variables} "CMAKE_ARGS=-DTOLD='two words'"
    "${PYTHON}" -m pip install --no-build-isolation --no-index --no-deps --disable-pip-version-check --upgrade
    --target "${TO}" "${package}" RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  set(${result} ${status} PARENT_SCOPE)
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Asks the installed package for its version, with these variables besides.
function(import result)
  execute_process(COMMAND "${CMAKE_COMMAND}" -E env --unset=SUREHIT_LIBRARY "PYTHONPATH=${TO}" ${ARGN}
    "${PYTHON}" -c "import surehit; print(surehit.__version__)" RESULT_VARIABLE status ERROR_VARIABLE output)
  set(${result} ${status} PARENT_SCOPE)
  set(output "${output}" PARENT_SCOPE)
endfunction()

install("${CMAKE_CURRENT_LIST_FILE}" status)
if(status EQUAL 0 OR NOT output MATCHES "which is no surehit of ABI 1")
  message(FATAL_ERROR "pip takes a library that is none")
endif()

foreach(library IN ITEMS "${LIBRARY}" "")
  file(REMOVE_RECURSE "${TO}")
  install("${library}" status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "pip does not install the package")
  endif()
  import(status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "the package cannot be imported: ${output}")
  endif()
endforeach()
if(NOT EXISTS "${TO}/surehit/py.typed")
  message(FATAL_ERROR "the package lacks its types")
endif()

# Without a library, the import says what to do.
import(status "SUREHIT_LIBRARY=${TO}/none.so")
if(status EQUAL 0 OR NOT output MATCHES "ImportError: surehit's shared library cannot be loaded")
  message(FATAL_ERROR "an import without a library says: ${output}")
endif()
