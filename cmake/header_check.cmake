# The target `header_check`: every header under src compiles alone.
option(BQSA_CHECK_HEADERS "Compile every header under src on its own" OFF)

if(BQSA_CHECK_HEADERS)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/src
    ${PROJECT_SOURCE_DIR}/src/*.hpp)
  set(sources)
  foreach(header IN LISTS headers)
    # One that its source file includes first is compiled alone by that.
    string(REGEX REPLACE "\\.hpp$" ".cpp" own_source ${PROJECT_SOURCE_DIR}/src/${header})
    if(EXISTS ${own_source})
      file(STRINGS ${own_source} first_include REGEX "^#include" LIMIT_COUNT 1)
      if(first_include STREQUAL "#include \"${header}\"")
        continue()
      endif()
    endif()
    set(source ${PROJECT_BINARY_DIR}/header_check/${header}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "#include \"${header}\"\n")
    list(APPEND sources ${source})
  endforeach()
  add_library(header_check OBJECT ${sources})
  bqsa_target(header_check)
  target_include_directories(header_check SYSTEM PRIVATE ${OMPL_INCLUDE_DIR})
  target_link_libraries(header_check PRIVATE
    program claims measuring fcl yaml-cpp nlohmann_json::nlohmann_json CLI11::CLI11 fmt::fmt)
endif()
