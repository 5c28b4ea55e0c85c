# Writes source_version.hpp with the commit that is being built; run at every build, and the file is
# touched only when its content changes. Sources without their own git repository give "unknown".
#   cmake -D SOURCE_DIR=... -D OUTPUT=... -P source_version.cmake
set(commit "unknown")
set(dirty false)
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} rev-parse --show-toplevel HEAD
    WORKING_DIRECTORY ${SOURCE_DIR} RESULT_VARIABLE failed OUTPUT_VARIABLE answer
    ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed)
    string(REPLACE "\n" ";" answer "${answer}")
    list(GET answer 0 top)
    file(REAL_PATH "${SOURCE_DIR}" source)
    if(top STREQUAL source)
      list(GET answer 1 commit)
      execute_process(COMMAND ${GIT} --no-optional-locks status --porcelain --untracked-files=no
        WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE changes)
      if(changes)
        set(dirty true)
      endif()
    endif()
  endif()
endif()

set(content "// Generated at every build.
#pragma once

namespace bqsa::harness {

inline constexpr const char* kSourceCommit = \"${commit}\";
inline constexpr bool kSourceDirty = ${dirty};

}  // namespace bqsa::harness
")
set(present "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" present)
endif()
if(NOT present STREQUAL content)
  file(WRITE "${OUTPUT}" "${content}")
endif()
