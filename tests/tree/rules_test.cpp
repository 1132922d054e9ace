// Every rule has a page that says what it is and shows a program that it reports and one that it does not.
#include "golden/page.h"
#include "rules/registry.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace feedhold {
namespace {

using golden::Fence;
using golden::Page;
using golden::Section;

std::string firstSentence(std::string_view text) {
  const std::size_t end = text.find(". ");
  const std::string_view sentence = text.substr(0, end);
  return std::string(sentence.substr(0, sentence.ends_with('.') ? sentence.size() - 1 : sentence.size()));
}

std::string withoutPoint(std::string_view text) {
  return std::string(text.ends_with('.') ? text.substr(0, text.size() - 1) : text);
}

bool hasTitle(const Section &section, std::string_view title) {
  return section.title == title || section.title.starts_with(std::string(title) + ": ");
}

/// How many sections of the page expect findings, and how many expect none.
struct Examples {
  std::size_t positive = 0;
  std::size_t negative = 0;
};

Examples examplesOf(const Page &page) {
  Examples examples;
  for (const Section &section : page.sections)
    for (const Fence &fence : section.fences)
      if (fence.info == "findings")
        ++(fence.text.empty() ? examples.negative : examples.positive);
  return examples;
}

TEST(RulePages, SayWhatTheRuleIs) {
  for (const auto &[rule, text] : allRules().rules) {
    SCOPED_TRACE(rule->info.name);
    const Page page = golden::parsePage(std::string(rule->info.name), text);
    EXPECT_EQ(page.title, rule->info.name);
    EXPECT_EQ(firstSentence(page.lead), withoutPoint(rule->info.summary));
    ASSERT_GE(page.sections.size(), 2u);
    EXPECT_EQ(page.sections[0].title, "Why it matters");
    EXPECT_EQ(page.sections[1].title, "What to do");
  }
}

TEST(RulePages, ShowAPositiveAndANegativeExample) {
  for (const auto &[rule, text] : allRules().rules) {
    SCOPED_TRACE(rule->info.name);
    const Examples examples = examplesOf(golden::parsePage(std::string(rule->info.name), text));
    EXPECT_GE(examples.positive, 1u);
    EXPECT_GE(examples.negative, 1u);
  }
}

TEST(RulePages, SayInTheTitleOfAnExampleWhetherItIsReported) {
  for (const auto &[rule, text] : allRules().rules) {
    const Page page = golden::parsePage(std::string(rule->info.name), text);
    for (const Section &section : page.sections) {
      SCOPED_TRACE(page.title + ": " + section.title);
      for (const Fence &fence : section.fences)
        EXPECT_TRUE(fence.info != "findings" || hasTitle(section, fence.text.empty() ? "Not reported" : "Reported"));
    }
  }
}

TEST(Rules, HaveNamesOfTheirOwnInKebabCase) {
  std::set<std::string_view> names;
  for (const auto &[rule, text] : allRules().rules) {
    EXPECT_TRUE(names.insert(rule->info.name).second) << rule->info.name;
    EXPECT_EQ(rule->info.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"), std::string_view::npos)
        << rule->info.name;
  }
  for (const auto &[rule, text] : allRules().rules)
    EXPECT_TRUE(rule->info.formerName.empty() || names.insert(rule->info.formerName).second) << rule->info.formerName;
}

TEST(Rules, ReportEverySyntaxIssue) {
  std::set<SyntaxIssueKind> reported;
  for (const auto &[rule, text] : allRules().rules)
    reported.insert(rule->hooks.issueKinds.begin(), rule->hooks.issueKinds.end());
#define ISSUE(kind) EXPECT_TRUE(reported.contains(SyntaxIssueKind::kind)) << "no rule reports " #kind;
#include "language/syntax/issues.def"
}

TEST(Rules, ReportEveryContractIssue) {
  std::set<ContractIssueKind> reported;
  for (const auto &[rule, text] : allRules().rules)
    reported.insert(rule->hooks.contractKinds.begin(), rule->hooks.contractKinds.end());
#define CONTRACT_ISSUE(kind) EXPECT_TRUE(reported.contains(ContractIssueKind::kind)) << "no rule reports " #kind;
#include "language/contract/issues.def"
}

} // namespace
} // namespace feedhold
