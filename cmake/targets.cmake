# What all targets of the project share: C++20 without extensions, warnings, sanitizers on request.
option(BQSA_SANITIZE "Build with the address and undefined-behaviour sanitizers" OFF)

function(bqsa_target name)
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    $<$<BOOL:${BQSA_WARNINGS_AS_ERRORS}>:-Werror>
    # g++ 12 takes the unused tail of Eigen's vectors of bounded size for an uninitialised read.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  if(BQSA_SANITIZE)
    target_compile_options(${name} PUBLIC
      $<BUILD_INTERFACE:-O1;-g1;-fsanitize=address,undefined;-fno-sanitize-recover=all>)
    target_link_options(${name} PUBLIC $<BUILD_INTERFACE:-fsanitize=address,undefined>)
    # Under this sanitizer Eigen would align memory by itself, which the packaged FCL and OMPL, who free
    # it, do not know of.
    target_compile_definitions(${name} PUBLIC EIGEN_MALLOC_ALREADY_ALIGNED=1)
  endif()
endfunction()

# A GoogleTest program: bqsa_test(NAME SOURCES ... LIBRARIES ...). Every test in it is one CTest.
function(bqsa_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  bqsa_target(${name})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gtest_main GTest::gmock)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()

# For a target with vector code (Highway): compiled once for each instruction set, chosen at run time.
# Left out are sets whose gain over their neighbours is small.
function(bqsa_use_highway name)
  target_link_libraries(${name} PRIVATE hwy::hwy)
  target_compile_definitions(${name} PRIVATE "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_AVX3_DL)")
endfunction()
