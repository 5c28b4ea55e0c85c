#include <fmt/format.h>

#include <array>
#include <memory>
#include <ostream>
#include <regex>
#include <system_error>

#include "harness/methods.hpp"
#include "harness/program/commands.hpp"
#include "harness/text_file.hpp"
#include "method_skeleton.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLongestName = 40;  // lines of the skeleton stay within the layout
constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr const char* kList = "src/harness/methods.def";

// Those of the language that could be names of methods.
constexpr std::array kKeywords = {"alignas",       "alignof",     "and",
                                  "and_eq",        "asm",         "auto",
                                  "bitand",        "bitor",       "bool",
                                  "break",         "case",        "catch",
                                  "char",          "char8_t",     "char16_t",
                                  "char32_t",      "class",       "compl",
                                  "concept",       "const",       "consteval",
                                  "constexpr",     "constinit",   "const_cast",
                                  "continue",      "co_await",    "co_return",
                                  "co_yield",      "decltype",    "default",
                                  "delete",        "do",          "double",
                                  "dynamic_cast",  "else",        "enum",
                                  "explicit",      "export",      "extern",
                                  "false",         "float",       "for",
                                  "friend",        "goto",        "if",
                                  "inline",        "int",         "long",
                                  "mutable",       "namespace",   "new",
                                  "noexcept",      "not",         "not_eq",
                                  "nullptr",       "operator",    "or",
                                  "or_eq",         "private",     "protected",
                                  "public",        "register",    "reinterpret_cast",
                                  "requires",      "return",      "short",
                                  "signed",        "sizeof",      "static",
                                  "static_assert", "static_cast", "struct",
                                  "switch",        "template",    "this",
                                  "thread_local",  "throw",       "true",
                                  "try",           "typedef",     "typeid",
                                  "typename",      "union",       "unsigned",
                                  "using",         "virtual",     "void",
                                  "volatile",      "wchar_t",     "while",
                                  "xor",           "xor_eq"};

/// `my_method` as a class is called: `MyMethod`.
std::string class_name(const std::string& name) {
  std::string text;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') text += begins && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    begins = c == '_';
  }
  return text;
}

std::string replaced(std::string text, const std::string& word, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += by.size()) {
    text.replace(at, word.size(), by);
  }
  return text;
}

std::string named(const char* skeleton, const std::string& name) {
  return replaced(replaced(skeleton, "skeleton", name), "Skeleton", class_name(name));
}

bool has_word(const std::string& text, const std::string& word) {
  return std::regex_search(text, std::regex("\\b" + word + "\\b"));
}

void check_name(const std::string& name, const std::vector<MethodEntry>& methods) {
  const auto refuse = [&name](const std::string& expected) {
    throw InputError(fmt::format("NAME: expected {}, got '{}'", expected, excerpt(name)));
  };
  if (!is_method_name(name) || name.find("__") != std::string::npos || name.back() == '_') {
    refuse("words [a-z0-9] with single underscores between them, a letter first");
  }
  if (name.size() > kLongestName) refuse(fmt::format("at most {} letters", kLongestName));
  for (const char* keyword : kKeywords) {
    if (name == keyword) refuse("no keyword of C++");
  }
  for (const MethodEntry& entry : methods) {
    if (entry.name == name) refuse("a name that no method has");
  }
  for (const char* skeleton : {kSkeletonHeader, kSkeletonSource, kSkeletonTest}) {
    if (has_word(skeleton, class_name(name)) && class_name(name) != "Skeleton") {
      refuse("a name whose class is not one that methods use");
    }
  }
}

struct NewFile {
  fs::path file;  ///< relative to the tree
  std::string content;
};

std::string list_with(const fs::path& tree, const std::string& name) {
  std::error_code unknown;
  for (const char* part : {kList, "src/baselines", "tests/baselines"}) {
    if (fs::exists(tree / part, unknown)) continue;
    throw InputError(
        fmt::format("{}: expected the source tree of bqsa-bench (--tree DIR), found no {} in it",
                    tree.string(), part));
  }
  std::string list = read_text_file(tree / kList, kMaxBytes);
  const std::string function = name + "_method";
  if (has_word(list, function)) {
    throw InputError(
        fmt::format("{}: expected no {}, found one", (tree / kList).string(), function));
  }
  if (!list.empty() && list.back() != '\n') list += '\n';
  return list + fmt::format("BQSA_METHOD(bqsa::baselines, {})\n", function);
}

}  // namespace

Status new_method_command(const std::vector<MethodEntry>& methods, const std::string& name,
                          const fs::path& tree, const Console& console) {
  check_name(name, methods);
  const std::string list = list_with(tree, name);
  const std::vector<NewFile> files = {
      {"src/baselines/" + name + ".hpp", named(kSkeletonHeader, name)},
      {"src/baselines/" + name + ".cpp", named(kSkeletonSource, name)},
      {"tests/baselines/" + name + "_test.cpp", named(kSkeletonTest, name)}};
  std::vector<std::unique_ptr<StagedTextFile>> staged;
  for (const NewFile& file : files) {
    const fs::path path = tree / file.file;
    std::error_code unknown;
    if (fs::symlink_status(path, unknown).type() != fs::file_type::not_found) {
      throw InputError(fmt::format("{}: expected no file, found one", path.string()));
    }
    staged.push_back(std::make_unique<StagedTextFile>(path, file.content));
  }
  staged.push_back(std::make_unique<StagedTextFile>(tree / kList, list));
  for (const auto& file : staged) file->commit();

  for (const NewFile& file : files) console.out << fmt::format("wrote {}\n", file.file.string());
  console.out << fmt::format(
      "added a line to {1}\n\n"
      "Your idea goes into avoidance() in src/baselines/{0}.cpp. Build and test it:\n"
      "  cmake --preset release -DBQSA_BUILD_TESTS=ON -DBQSA_BUILD_BENCHMARKS=OFF\n"
      "  cmake --build --preset release --target bqsa-bench baselines_test conformance_test\n"
      "  ctest --preset release -R '{2}|{0}'\n"
      "See what it does:\n"
      "  build/release/src/harness/program/bqsa-bench run scenarios -m none -m {0} --out "
      "results/local/{0}\n"
      "More: docs/adding_a_method.md\n",
      name, kList, class_name(name));
  return kOk;
}

}  // namespace bqsa::harness
