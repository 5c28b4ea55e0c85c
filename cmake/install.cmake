# Installs libraries, headers and the program, so that another project can say
#   find_package(bqsa-bench REQUIRED COMPONENTS bqsa)
#   target_link_libraries(its_program PRIVATE bqsa::bqsa)
include(CMakePackageConfigHelpers)

set(BQSA_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/bqsa-bench)

install(TARGETS bqsa baselines baselines_fcl baselines_ompl mixes harness measuring exchange figures claims problem_sets report program
  EXPORT bqsa-bench-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/bqsa-bench)
if(TARGET bqsa-bench)
  install(TARGETS bqsa-bench RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

install(DIRECTORY src/bqsa src/baselines src/mixes src/harness
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.hpp" PATTERN "skeleton" EXCLUDE)

install(EXPORT bqsa-bench-targets NAMESPACE bqsa:: DESTINATION ${BQSA_PACKAGE_DIR})
configure_package_config_file(cmake/bqsa-bench-config.cmake.in
  ${PROJECT_BINARY_DIR}/bqsa-bench-config.cmake INSTALL_DESTINATION ${BQSA_PACKAGE_DIR}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bqsa-bench-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
    ${PROJECT_BINARY_DIR}/bqsa-bench-config.cmake
    ${PROJECT_BINARY_DIR}/bqsa-bench-config-version.cmake
  DESTINATION ${BQSA_PACKAGE_DIR})
