# examples/own_method is a program with all commands and one method more.
include(${CMAKE_CURRENT_LIST_DIR}/package_user.cmake)
file(REMOVE_RECURSE ${WORK_DIR})
configure(${SOURCE_DIR}/examples/own_method ${WORK_DIR})
build(${WORK_DIR})
set(program ${WORK_DIR}/own-bench)
set(scenario ${SOURCE_DIR}/scenarios/planar_7r.yaml)

expect_status(0 ${program} list)
expect_printed("\n  bqsa  " "\n  try_each_joint .*; out of tree\n *near ")
expect_status(0 ${program} --version)
expect_printed("with try_each_joint out of tree\n$")

expect_status(0 ${program} run ${scenario} -m none -m try_each_joint:near=0.06 --out ${WORK_DIR}/results)
expect_printed("x +none +collides" "\\+ +try_each_joint@[0-9a-f]+ +success")
file(READ ${WORK_DIR}/results/runs.jsonl printed)
expect_printed("\"out_of_tree\":\\[\"try_each_joint\"\\]" "\"near\":0.06")

expect_status(0 ${program} conform -m try_each_joint ${SOURCE_DIR}/scenarios)
expect_printed("applies to 3 of 3 scenarios" "passed +repeatability" "passed +limits")

# A name that is taken is refused, whatever is asked for.
file(READ ${SOURCE_DIR}/examples/own_method/own_method.cpp text)
string(REPLACE "\"try_each_joint\"" "\"bqsa\"" text "${text}")
file(WRITE ${WORK_DIR}/taken/own_method.cpp "${text}")
file(COPY ${SOURCE_DIR}/examples/own_method/CMakeLists.txt DESTINATION ${WORK_DIR}/taken)
configure(${WORK_DIR}/taken ${WORK_DIR}/taken/build)
build(${WORK_DIR}/taken/build)
expect_status(2 ${WORK_DIR}/taken/build/own-bench list)
expect_printed("method 'bqsa' added by this program: the name is taken")
