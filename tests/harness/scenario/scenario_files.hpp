/// @file
/// Small scenario files for tests.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "harness/scenario/scenario.hpp"

namespace bqsa::harness {

/// A directory of its own for each test, gone with the object.
class TestDirectory {
 public:
  TestDirectory() {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    path_ =
        std::filesystem::path(testing::TempDir()) / (std::string(test->test_suite_name()) + '.' +
                                                     test->name() + '.' + std::to_string(getpid()));
    std::filesystem::create_directories(path_);
  }
  ~TestDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestDirectory(const TestDirectory&) = delete;
  TestDirectory& operator=(const TestDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

  Scenario load(const std::string& content) const {
    return load_scenario(write("s.yaml", content));
  }

 private:
  std::filesystem::path path_;
};

/// What an InputError says, without the directory; "no error" if there is none.
template <typename Function>
std::string message_of(const TestDirectory& directory, Function&& function) {
  try {
    function();
  } catch (const InputError& error) {
    std::string message = error.what();
    const std::string prefix = directory.path().string() + '/';
    if (message.starts_with(prefix)) message.erase(0, prefix.size());
    return message;
  }
  return "no error";
}

/// The text with one part replaced, which must be there.
inline std::string with(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  if (at != std::string::npos) text.replace(at, part.size(), by);
  return text;
}

}  // namespace bqsa::harness
