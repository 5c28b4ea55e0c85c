# How the scripts of this folder build and run things. They are given
#   -D PREFIX -D SOURCE_DIR -D CONFIG -D GENERATOR -D COMPILER -D FLAGS -D WORK_DIR

# Configures the project in `source` to be built in `build`, with further options.
function(configure source build)
  execute_process(COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET
    COMMAND ${CMAKE_COMMAND} -S ${source} -B ${build} -G ${GENERATOR}
      -D CMAKE_PREFIX_PATH=${PREFIX} -D CMAKE_BUILD_TYPE=${CONFIG}
      -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_FLAGS=${FLAGS} ${ARGN})
endfunction()

# Builds the targets named, or all.
function(build build)
  set(targets)
  if(ARGN)
    set(targets --target ${ARGN})
  endif()
  execute_process(COMMAND_ERROR_IS_FATAL ANY
    COMMAND ${CMAKE_COMMAND} --build ${build} --config ${CONFIG} ${targets})
endfunction()

# Runs a command, which has to end with `status`, and leaves what it prints in `printed`.
function(expect_status status)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE ended OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT ended EQUAL status)
    message(FATAL_ERROR "${ARGN}: expected exit status ${status}, got ${ended}\n${out}${err}")
  endif()
  set(printed "${out}${err}" PARENT_SCOPE)
endfunction()

# Each text, a regular expression, has to be in `printed`.
function(expect_printed)
  foreach(text IN LISTS ARGN)
    if(NOT printed MATCHES "${text}")
      message(FATAL_ERROR "expected '${text}' in\n${printed}")
    endif()
  endforeach()
endfunction()
