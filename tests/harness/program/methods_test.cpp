#include "harness/methods.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "harness/results/provenance.hpp"
#include "test_methods.hpp"

namespace bqsa::harness {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

MethodEntry entry_named(const std::string& name) { return scripted(name, stand_still).entry; }

std::string refusal(const std::vector<MethodEntry>& added) {
  try {
    add_methods(added);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Methods, AreInTheOrderInWhichTablesShowThem) {
  std::vector<std::string> names;
  for (const MethodEntry& entry : methods()) names.push_back(entry.name);
  std::erase_if(names, [](const std::string& name) {
    constexpr std::array kSome{"none", "bqsa", "test_point", "qp", "ompl"};
    return std::ranges::find(kSome, name) == kSome.end();
  });
  EXPECT_THAT(names, ElementsAre("none", "bqsa", "test_point", "qp", "ompl"));
}

TEST(Methods, AddedByAProgramComeLastAndAreMarked) {
  const std::vector<MethodEntry> all = add_methods({entry_named("mine"), entry_named("mine2")});
  ASSERT_EQ(all.size(), methods().size() + 2);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].out_of_tree, i >= methods().size()) << all[i].name;
  }
  EXPECT_THAT(names_out_of_tree(all), ElementsAre("mine", "mine2"));
  EXPECT_THAT(names_out_of_tree(methods()), IsEmpty());
}

TEST(Methods, ThatCannotBeAddedAreRefused) {
  EXPECT_EQ(refusal({entry_named("mine")}), "");
  EXPECT_EQ(refusal({entry_named("bqsa")}),
            "method 'bqsa' added by this program: the name is taken");
  EXPECT_THAT(refusal({entry_named("mine"), entry_named("mine")}), HasSubstr("the name is taken"));
  EXPECT_THAT(refusal({entry_named("Mine")}),
              HasSubstr("expected a name [a-z][a-z0-9_]*, got 'Mine'"));
  EXPECT_THAT(refusal({entry_named("")}), HasSubstr("expected a name"));
  MethodEntry empty = entry_named("mine");
  empty.make = nullptr;
  EXPECT_THAT(refusal({empty}), HasSubstr("has no `make`"));
}

TEST(Methods, OutOfTreeAreInTheVersion) {
  EXPECT_THAT(version_text({"mine", "mine2"}), EndsWith("), with mine, mine2 out of tree"));
  EXPECT_THAT(version_text(), EndsWith(")"));
}

}  // namespace
}  // namespace bqsa::harness
