// feedhold.toml: what is read, and where and how a slip of the pen is reported.
#include "dialects/registry.h"
#include "findings/project/config.h"
#include "findings/project/selection.h"
#include "rules/registry.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace feedhold {
namespace {

ConfigText read(std::string_view text) { return readConfig(text, "/shop", {allDialects(), allRules()}); }

/// "line:column message" of the only error.
std::string errorOf(std::string_view text) {
  const ConfigText config = read(text);
  if (config.errors.size() != 1)
    return fmt::format("{} errors", config.errors.size());
  const ConfigError &error = config.errors.front();
  return fmt::format("{}:{} {}", error.line, error.column, error.message);
}

TEST(Config, EverySetting) {
  const ConfigText text = read("dialect = \"fanuc-0i\"\n"
                               "select = [\"syntax\", \"missing-value\"]\n"
                               "ignore = [\"missing-equals\"]\n"
                               "error-on = \"error\"\n"
                               "include = [\"*.P-1\"]\n"
                               "exclude = [\"old/\"]\n"
                               "[switches]\n"
                               "dpi = true\n"
                               "mlg = \"unknown\"\n"
                               "[[code-calls]]\n"
                               "code = \"G100.1\"\n"
                               "program = 9010\n"
                               "macro = false\n"
                               "[severity]\n"
                               "missing-value = \"info\"\n"
                               "[[files]]\n"
                               "path = \"lathe/**\"\n"
                               "dialect = \"haas-ngc\"\n"
                               "switches = { sqc = true }\n");
  ASSERT_TRUE(text.errors.empty()) << text.errors[0].message;
  const Config &config = text.config;
  EXPECT_EQ(config.dialect, "fanuc-0i");
  EXPECT_EQ(config.select, (std::vector<std::string>{"syntax", "missing-value"}));
  EXPECT_EQ(config.errorOn, Severity::Error);
  EXPECT_EQ(config.exclude, (std::vector<std::string>{"old/"}));
  ASSERT_EQ(config.switches.size(), 2U);
  EXPECT_EQ(config.switches[0].value, Switch::On);
  EXPECT_EQ(config.switches[1].value, Switch::Unknown);
  ASSERT_EQ(config.codeCalls.size(), 1U);
  EXPECT_EQ(config.codeCalls[0].tenths, 1001);
  EXPECT_EQ(config.codeCalls[0].program, 9010U);
  EXPECT_FALSE(config.codeCalls[0].isMacro);
  ASSERT_EQ(config.severities.size(), 1U);
  EXPECT_EQ(config.severities[0].severity, Severity::Info);
  ASSERT_EQ(config.files.size(), 1U);
  EXPECT_EQ(config.files[0].dialect, "haas-ngc");
  EXPECT_TRUE(config.files[0].switches[0].which == &Switches::sqc);
}

TEST(Config, UnknownKeysHaveASuggestion) {
  EXPECT_EQ(errorOf("\ndialct = \"fanuc-0i\"\n"), "2:1 unknown setting `dialct`; did you mean `dialect`?");
  EXPECT_EQ(errorOf("[switches]\n  dip = true\n"), "2:3 unknown setting `dip`; did you mean `dpi`?");
  EXPECT_EQ(errorOf("[[files]]\npath = \"x\"\nignor = []\n"), "3:1 unknown setting `ignor`; did you mean `ignore`?");
}

TEST(Config, UnknownNamesHaveASuggestion) {
  EXPECT_EQ(errorOf("dialect = \"fanuc-3oi\"\n"), "1:11 there is no dialect `fanuc-3oi`; did you mean `fanuc-30i`?");
  EXPECT_EQ(errorOf("ignore = [\"syntax\", \"mising-equals\"]\n"),
            "1:21 there is no rule or category `mising-equals`; did you mean `missing-equals`?");
  EXPECT_EQ(errorOf("[severity]\nmising-equals = \"info\"\n"),
            "2:1 there is no rule or category `mising-equals`; did you mean `missing-equals`?");
  EXPECT_EQ(errorOf("error-on = \"errors\"\n"), "1:12 `errors` is not a severity; did you mean `error`?");
}

TEST(Config, IncrementSystem) {
  const ConfigText text = read("increment-system = \"IS-C\"\n[[files]]\npath = \"x\"\nincrement-system = \"IS-A\"\n");
  EXPECT_TRUE(text.errors.empty());
  EXPECT_EQ(text.config.incrementSystem, IncrementSystem::C);
  EXPECT_EQ(text.config.files[0].incrementSystem, IncrementSystem::A);
  EXPECT_EQ(errorOf("increment-system = \"IS-D\"\n"),
            "1:20 `IS-D` is not an increment system; one of: IS-A, IS-B, IS-C");
}

TEST(Config, CodesOfTheBuilder) {
  const ConfigText text = read("builders-codes = [\"M462\", \"g68.2\", \"G229\", \"G68.2\"]\n");
  EXPECT_TRUE(text.errors.empty());
  EXPECT_EQ(text.config.buildersCodes, (std::vector<CodeName>{{'G', 682}, {'G', 2290}, {'M', 4620}}));
  EXPECT_EQ(errorOf("builders-codes = \"G229\"\n"),
            "1:18 `builders-codes` must be a list of G and M codes in quotes, such as [\"G229\", \"M462\"]");
  for (const char *code : {"229", "\"T1\"", "\"G68.25\"", "\"\""})
    EXPECT_EQ(errorOf(fmt::format("builders-codes = [{}]\n", code)),
              "1:19 a code of the machine builder is a G or M code in quotes, such as \"G68.2\"");
}

TEST(Config, WhatChangesADialectIsPartOfItsText) {
  Switches switches;
  const std::string before = textOf(switches);
  switches.buildersCodes = {{'M', 4620}};
  EXPECT_NE(textOf(switches), before);
}

TEST(Config, GCodeSystem) {
  const ConfigText text = read("g-code-system = \"B\"\n[[files]]\npath = \"x\"\ng-code-system = \"C\"\n");
  EXPECT_TRUE(text.errors.empty());
  EXPECT_EQ(text.config.gCodeSystem, GCodeSystem::B);
  EXPECT_EQ(text.config.files[0].gCodeSystem, GCodeSystem::C);
  EXPECT_EQ(errorOf("g-code-system = \"D\"\n"), "1:17 `D` is not a G code system; one of: A, B, C");
}

TEST(Config, AFormerNameOfARuleIsUnderstood) {
  EXPECT_EQ(errorOf("select = [\"loop-counter-clobbered\"]\n[severity]\nloop-counter-clobbered = \"info\"\n"),
            "0 errors");
  const auto rules =
      selectRules(allRules(), {{SelectionStep::Kind::Select, {"loop-counter-clobbered", "missing-equals"}},
                               {SelectionStep::Kind::Ignore, {"missing-equals"}}});
  ASSERT_EQ(rules.size(), 1U);
  EXPECT_EQ(rules[0]->info.name, "shared-loop-counter");
}

TEST(Config, WrongValues) {
  EXPECT_EQ(errorOf("ignore = \"syntax\"\n"), "1:10 expected a list of strings: [\"..\", \"..\"]");
  EXPECT_EQ(errorOf("[switches]\ndpi = 1\n"), "2:7 expected true, false or \"unknown\"");
  EXPECT_EQ(errorOf("[[code-calls]]\ncode = \"X1\"\nprogram = 1\n"),
            "2:8 `code` must be a G, M or T code, such as \"G100\" or \"M6\"");
  EXPECT_EQ(errorOf("[[code-calls]]\ncode = \"G1\"\nprogram = -1\n"),
            "3:11 `program` must be a program number, such as 9010");
  EXPECT_EQ(errorOf("[[files]]\ndialect = \"fanuc-0i\"\n"),
            "1:1 [[files]] needs a `path`: the pattern of the files it is for");
}

TEST(Config, ErrorsComeInOrderOfTheText) {
  const ConfigText text = read("zzz = 1\naaa = 2\n[check\n");
  ASSERT_EQ(text.errors.size(), 1U);
  EXPECT_TRUE(text.errors[0].message.starts_with("not valid TOML: "));
  const ConfigText keys = read("zzz = 1\naaa = 2\n");
  ASSERT_EQ(keys.errors.size(), 2U);
  EXPECT_EQ(keys.errors[0].line, 1U);
}

TEST(Config, Patterns) {
  EXPECT_TRUE(patternMatches("*.nc", "cell/one/part.nc"));
  EXPECT_TRUE(patternMatches("old/", "old/part.nc"));
  EXPECT_TRUE(patternMatches("old", "cell/old/part.nc"));
  EXPECT_TRUE(patternMatches("cell/*.nc", "cell/part.nc"));
  EXPECT_FALSE(patternMatches("cell/*.nc", "cell/one/part.nc"));
  EXPECT_FALSE(patternMatches("old/", "older/part.nc"));
}

} // namespace
} // namespace feedhold
