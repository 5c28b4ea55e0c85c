// `new-method` in trees that hold no more than it looks at. That what it writes builds and works is
// shown by skeleton_test, conformance_test and tests/install.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program_runner.hpp"

namespace bqsa::harness {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

const std::string kList =
    "BQSA_METHOD(bqsa, bqsa_method)\nBQSA_METHOD(bqsa::baselines, spare_method)";

class NewMethod : public ::testing::Test {
 protected:
  NewMethod() {
    for (const char* part : {"src/harness", "src/baselines", "tests/baselines"}) {
      fs::create_directories(tree() / part);
    }
    write_file(list(), kList);
  }

  fs::path tree() const { return directory_.path(); }
  fs::path list() const { return tree() / "src/harness/methods.def"; }

  ProgramResult call(const std::string& name) const {
    return run_bqsa_bench({"new-method", name, "--tree", tree().string()});
  }

  /// Files of the tree, and what the list holds.
  std::vector<std::string> content() const {
    std::vector<std::string> all = {content_of(list())};
    for (const auto& entry : fs::recursive_directory_iterator(tree())) {
      if (entry.is_regular_file()) all.push_back(entry.path().string());
    }
    return all;
  }

  void expect_refused(const std::string& name, const std::string& message) const {
    const std::vector<std::string> before = content();
    const ProgramResult result = call(name);
    EXPECT_EQ(result.status, 2) << name;
    EXPECT_THAT(result.err, HasSubstr(message)) << name;
    EXPECT_EQ(content(), before) << name;
  }

 private:
  TemporaryDirectory directory_;
};

TEST_F(NewMethod, IsTheSkeletonUnderItsNameAndOneLineAtTheEndOfTheList) {
  const ProgramResult result = call("far_reach2");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("wrote src/baselines/far_reach2.cpp\n"));
  EXPECT_EQ(content_of(list()), kList + "\nBQSA_METHOD(bqsa::baselines, far_reach2_method)\n");
  for (const char* end : {".hpp", ".cpp", "_test.cpp"}) {
    const bool test = std::string(end) == "_test.cpp";
    const fs::path file =
        tree() / (test ? "tests/baselines" : "src/baselines") / (std::string("far_reach2") + end);
    std::string text = content_of(file);
    EXPECT_THAT(text, Not(HasSubstr("keleton"))) << file;
    for (const auto& [name, skeleton] :
         {std::pair<std::string, std::string>("far_reach2", "skeleton"),
          std::pair<std::string, std::string>("FarReach2", "Skeleton")}) {
      for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos;) {
        text.replace(at, name.size(), skeleton);
      }
    }
    const std::string folder = BQSA_SOURCE_DIR "/src/harness/program/skeleton/baselines/skeleton";
    EXPECT_EQ(text, content_of(folder + end));
  }
}

TEST_F(NewMethod, IsNotWrittenTwice) {
  ASSERT_EQ(call("idea").status, 0);
  expect_refused("idea", "methods.def: expected no idea_method, found one");
}

TEST_F(NewMethod, NeedsAUsableName) {
  for (const char* name :
       {"Idea", "2nd", "my-idea", "my idea", "idea_", "_idea", "my__idea", "", "é", "../idea"}) {
    expect_refused(name, "NAME: expected words [a-z0-9]");
  }
  expect_refused(std::string(41, 'a'), "at most 40 letters");
  expect_refused("class", "expected no keyword of C++, got 'class'");
  expect_refused("co_await", "no keyword");
  expect_refused("ompl", "a name that no method has");
  expect_refused("none", "a name that no method has");
  expect_refused("spare", "expected no spare_method");
  // Its class would hide that of the contract.
  expect_refused("reactive_method", "a name whose class is not one that methods use");
  expect_refused("problem", "a name whose class is not one that methods use");
}

TEST_F(NewMethod, OverwritesNothing) {
  for (const char* there :
       {"src/baselines/idea.hpp", "src/baselines/idea.cpp", "tests/baselines/idea_test.cpp"}) {
    write_file(tree() / there, "mine");
    expect_refused("idea", std::string(there) + ": expected no file, found one");
    EXPECT_EQ(content_of(tree() / there), "mine");
    fs::remove(tree() / there);
  }
  fs::create_symlink("/nonexistent", tree() / "src/baselines/idea.hpp");
  expect_refused("idea", "idea.hpp: expected no file, found one");
}

TEST_F(NewMethod, NeedsTheSourceTree) {
  const ProgramResult elsewhere = run_bqsa_bench({"new-method", "idea"}, {}, "/");
  EXPECT_EQ(elsewhere.status, 2);
  EXPECT_THAT(elsewhere.err,
              HasSubstr("expected the source tree of bqsa-bench (--tree DIR), found no "
                        "src/harness/methods.def in it"));
  EXPECT_EQ(run_bqsa_bench({"new-method", "idea"}, {}, tree()).status, 0) << "called in the tree";
}

}  // namespace
}  // namespace bqsa::harness
