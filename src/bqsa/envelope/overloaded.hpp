/// @file
/// Functions for each alternative of a std::variant, for std::visit.
#pragma once

namespace bqsa {

template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;  // clang 14 does not deduce it

}  // namespace bqsa
