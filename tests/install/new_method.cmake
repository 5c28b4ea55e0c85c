# What `bqsa-bench new-method` writes is part of the next build, and works: in a copy of the source tree
# its objects are built; linked with the package, so that nothing else has to be, they are run.
include(${CMAKE_CURRENT_LIST_DIR}/package_user.cmake)
file(REMOVE_RECURSE ${WORK_DIR})
set(tree ${WORK_DIR}/tree)
foreach(part CMakeLists.txt benchmarks cmake src tests)
  file(COPY ${SOURCE_DIR}/${part} DESTINATION ${tree})
endforeach()
configure(${tree} ${WORK_DIR}/in_tree
  -D BQSA_BUILD_TESTS=ON -D BQSA_BUILD_BENCHMARKS=OFF -D BQSA_WARNINGS_AS_ERRORS=ON)

expect_status(0 ${PREFIX}/bin/bqsa-bench new-method fresh_idea --tree ${tree})
if(GENERATOR STREQUAL Ninja)
  build(${WORK_DIR}/in_tree
    src/baselines/CMakeFiles/baselines.dir/fresh_idea.cpp.o
    src/harness/CMakeFiles/harness.dir/methods.cpp.o
    tests/baselines/CMakeFiles/baselines_test.dir/fresh_idea_test.cpp.o)
endif()

configure(${CMAKE_CURRENT_LIST_DIR}/new_method ${WORK_DIR}/linked -D TREE=${tree})
build(${WORK_DIR}/linked)
expect_status(0 ${WORK_DIR}/linked/fresh_idea_test)
expect_printed("\\[ RUN      \\] FreshIdea\\." "\\[  PASSED  \\]")
expect_status(0 ${WORK_DIR}/linked/fresh-bench conform -m fresh_idea ${SOURCE_DIR}/scenarios)
expect_printed("applies to 3 of 3 scenarios" "passed +limits")
