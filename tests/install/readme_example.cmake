# The example of the README is a program that builds against the package and runs.
include(${CMAKE_CURRENT_LIST_DIR}/package_user.cmake)
file(REMOVE_RECURSE ${WORK_DIR})
configure(${CMAKE_CURRENT_LIST_DIR}/consumer ${WORK_DIR} -D README=${SOURCE_DIR}/README.md)
build(${WORK_DIR})
expect_status(0 ${WORK_DIR}/consumer)
