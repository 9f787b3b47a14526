# -ffast-math forced onto either library is a compile error that says so.
include("${CMAKE_CURRENT_LIST_DIR}/consumer_project.cmake")

file(REMOVE_RECURSE "${TEST_FOLDER}")
copy_library_sources("${TEST_FOLDER}/surehit")

foreach(library IN ITEMS surehit_broadphase surehit_collision)
  # Collision has the objects of broadphase, so these are compiled first. Together they take less time.
  configure_consumer("-DSUREHIT_SOURCE_FOLDER=${TEST_FOLDER}/surehit" "-DFORCE_FAST_MATH_ON=${library}"
    -DCMAKE_UNITY_BUILD=ON -DSUREHIT_OPTIMIZED=OFF)
  execute_process(COMMAND "${CMAKE_COMMAND}" --build "${TEST_FOLDER}/build" --parallel 1 --target ${library}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(result EQUAL 0)
    message(FATAL_ERROR "${library} was built with -ffast-math")
  elseif(NOT output MATCHES "#error[^\n]*fast-math")
    message(FATAL_ERROR "${library} was not built, but no #error speaks of fast-math:\n${output}")
  endif()
endforeach()
