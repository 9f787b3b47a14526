# What a shared library has to be, as functions for the tests of this folder.

# It exports the classes and all functions of C, and nothing of what is hidden.
function(check_exports library)
  execute_process(COMMAND "${NM}" --dynamic --defined-only --demangle "${library}"
    OUTPUT_VARIABLE exported COMMAND_ERROR_IS_FATAL ANY)
  if(NOT exported MATCHES "surehit::Collider<float>::first_hit")
    message(FATAL_ERROR "the shared library does not export colliders:\n${exported}")
  elseif(exported MATCHES "[^\n]*(hwy|surehit::(c|Grid|MeshBlocks|ClippedPath|FloatingPointEnvironment))::[^\n]*")
    message(FATAL_ERROR "the shared library exports ${CMAKE_MATCH_0}")
  endif()

  set(functions 0)
  file(GLOB headers "${SOURCE_FOLDER}/collision/include/surehit/c/*.h")
  foreach(header IN LISTS headers)
    file(STRINGS "${header}" declarations REGEX "^SUREHIT_C_API ")
    foreach(declaration IN LISTS declarations)
      string(REGEX MATCH "(surehit_[a-z0-9_]+)\\(" ignored "${declaration}")
      if(NOT exported MATCHES " ${CMAKE_MATCH_1}\n")
        message(FATAL_ERROR "the shared library does not export ${CMAKE_MATCH_1}:\n${exported}")
      endif()
      math(EXPR functions "${functions} + 1")
    endforeach()
  endforeach()
  if(functions LESS 100)
    message(FATAL_ERROR "only ${functions} functions of C were found")
  endif()
endfunction()

# A program in C# finds it by its name, and prints what the guide says.
function(check_csharp_program library_folder)
  run("${CSHARP_COMPILER}" -unsafe "-out:${TEST_FOLDER}/program.exe" "${CSHARP_PROGRAM}.cs")
  execute_process(COMMAND "${CMAKE_COMMAND}" -E env "LD_LIBRARY_PATH=${library_folder}" "${MONO}" "${TEST_FOLDER}/program.exe"
    OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
  file(READ "${CSHARP_PROGRAM}.txt" expected)
  if(NOT printed STREQUAL expected)
    message(FATAL_ERROR "the program in C# prints:\n${printed}")
  endif()
endfunction()
