# A project that embeds the sources by FetchContent builds and works, and installs nothing of surehit's.
include("${CMAKE_CURRENT_LIST_DIR}/consumer_project.cmake")

file(REMOVE_RECURSE "${TEST_FOLDER}")
copy_library_sources("${TEST_FOLDER}/surehit")
separate_arguments(OPTIONS)
configure_consumer("-DSUREHIT_SOURCE_FOLDER=${TEST_FOLDER}/surehit" ${OPTIONS})
build_and_run_consumer()

file(GLOB_RECURSE shared_library "${TEST_FOLDER}/build/*/libsurehit.so")
if(shared_library)
  execute_process(COMMAND "${NM}" --dynamic --defined-only --demangle "${shared_library}"
    OUTPUT_VARIABLE exported COMMAND_ERROR_IS_FATAL ANY)
  if(NOT exported MATCHES "surehit::Collider<float>::first_hit")
    message(FATAL_ERROR "the shared library does not export colliders:\n${exported}")
  elseif(NOT exported MATCHES " surehit_colliderf_first_hit\n" OR NOT exported MATCHES " surehit_scened_commit\n")
    message(FATAL_ERROR "the shared library does not export the C interface:\n${exported}")
  elseif(exported MATCHES "[^\n]*(hwy|surehit::(c|Grid|MeshBlocks|ClippedPath|FloatingPointEnvironment))::[^\n]*")
    message(FATAL_ERROR "the shared library exports ${CMAKE_MATCH_0}")
  endif()

  # A program in C# finds it by its name.
  if(CSHARP_COMPILER)
    run("${CSHARP_COMPILER}" -unsafe "-out:${TEST_FOLDER}/program.exe" "${CSHARP_PROGRAM}.cs")
    get_filename_component(library_folder "${shared_library}" DIRECTORY)
    execute_process(COMMAND "${CMAKE_COMMAND}" -E env "LD_LIBRARY_PATH=${library_folder}" "${MONO}" "${TEST_FOLDER}/program.exe"
      OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
    file(READ "${CSHARP_PROGRAM}.txt" expected)
    if(NOT printed STREQUAL expected)
      message(FATAL_ERROR "the program in C# prints:\n${printed}")
    endif()
  endif()
endif()

run("${CMAKE_COMMAND}" --install "${TEST_FOLDER}/build" --prefix "${TEST_FOLDER}/installed")
file(GLOB_RECURSE installed RELATIVE "${TEST_FOLDER}/installed" "${TEST_FOLDER}/installed/*")
if(NOT installed STREQUAL "bin/consumer")
  message(FATAL_ERROR "the embedding project installs more than its own program: ${installed}")
endif()
