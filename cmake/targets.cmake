# One function for every target of the project: C++20, warnings, no compiler extensions.
function(bqsa_target name)
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    $<$<BOOL:${BQSA_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()
