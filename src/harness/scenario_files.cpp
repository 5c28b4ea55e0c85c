#include "harness/scenario_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>

namespace bqsa::harness {

std::vector<std::filesystem::path> yaml_files(const std::filesystem::path& directory) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory, error)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  if (error) {
    throw InputError(
        fmt::format("{}: cannot list scenarios: {}", directory.string(), error.message()));
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::filesystem::path> with_directories_opened(
    const std::vector<std::filesystem::path>& named) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& name : named) {
    std::error_code not_there;
    if (!std::filesystem::is_directory(name, not_there)) {
      files.push_back(name);
      continue;
    }
    const std::vector<std::filesystem::path> inside = yaml_files(name);
    if (inside.empty()) {
      throw InputError(
          fmt::format("{}: expected scenario files *.yaml, found none", name.string()));
    }
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

}  // namespace bqsa::harness
