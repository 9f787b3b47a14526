# Another build system that leaves out the flags of our CMake gets an error that names what is missing.
file(REMOVE_RECURSE "${TEST_FOLDER}")
file(MAKE_DIRECTORY "${TEST_FOLDER}")
set(source "${SOURCE_FOLDER}/broadphase/src/support/floating_point_environment.cpp")

function(compile expected_error)
  execute_process(COMMAND "${COMPILER}" -std=c++20 -fsyntax-only "-I${SOURCE_FOLDER}/broadphase/include"
    "-I${SOURCE_FOLDER}/broadphase/src" -isystem "${EIGEN_FOLDER}" ${ARGN} "${source}"
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(expected_error STREQUAL "")
    if(NOT result EQUAL 0)
      message(FATAL_ERROR "with ${ARGN} it does not compile:\n${output}")
    endif()
  elseif(result EQUAL 0 OR NOT output MATCHES "#error[^\n]*${expected_error}")
    message(FATAL_ERROR "with ${ARGN} no #error names ${expected_error}:\n${output}")
  endif()
endfunction()

compile("" -ffp-contract=off -DSUREHIT_COMPILED_WITHOUT_FP_CONTRACTION)
compile("-ffp-contract=off" -ffp-contract=off)
compile("-ffast-math" -ffast-math -DSUREHIT_COMPILED_WITHOUT_FP_CONTRACTION)
