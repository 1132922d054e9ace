// Every format on one small result that has something of everything.
#include "surface/sink/sink.h"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace feedhold {
namespace {

using Json = nlohmann::json;

constexpr RuleInfo kSlip{"missing-equals", Category::Syntax, Severity::Error, "Reports a slip."};
constexpr RuleInfo kStyle{"plain-style", Category::Comment, Severity::Info, "Reports a style."};
constexpr Rule kSlipRule{kSlip, {}};
constexpr Rule kStyleRule{kStyle, {}};
constexpr RegisteredRule kRules[] = {{&kSlipRule, "# missing-equals\n"}, {&kStyleRule, "# plain-style\n"}};

/// Two findings, one of them allowed by a comment; a file that was skipped; a path that does not exist.
CheckResult sample() {
  const SourceFile source = SourceFile::fromText("cell 1/part.nc", "O1(\xc3\xa4<&>)\n#510-#6\nM30\n");
  Finding slip{&kSlip, Severity::Error, {}, "0123456789abcdef", false};
  slip.diagnostic.message = "`#510-#6` is 50% of a statement";
  slip.diagnostic.span = {10, 17};
  slip.diagnostic.labels = {{{0, 2}, "in this program"}};
  slip.diagnostic.flow = {{{0, 9}, "the condition holds"}};
  slip.diagnostic.notes = {"the control stops"};
  slip.diagnostic.fixes = {{FixSafety::NeedsReview, "write `=`", {{{14, 15}, "="}}}};
  Finding style{&kStyle, Severity::Info, {}, "fedcba9876543210", true};
  style.diagnostic.message = "a <comment>";
  style.diagnostic.span = {2, 9};
  return {{{"cell 1/part.nc",
            source,
            "fanuc-30i",
            DialectChoice::Guess,
            {},
            Severity::Warning,
            Severity::Info,
            {style, slip}}},
          {{"picture.nc", "a binary file"}},
          {{"gone.nc", "no such file"}}};
}

class Sink : public testing::Test {
protected:
  Report report(ShowSuppressed show = ShowSuppressed::No) const {
    return {
        .result = result_, .rules = rules_, .version = "1.2.3", .root = "/shop", .exitCode = 2, .showSuppressed = show};
  }
  CheckResult result_ = sample();
  RuleRegistry rules_{kRules};
};

bool followsSchema(const Json &document) {
  std::ifstream file(FEEDHOLD_SOURCE_DIR "/docs/schemas/check.schema.json");
  const Json text = Json::parse(file);
  valijson::Schema schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(text), schema);
  return valijson::Validator().validate(schema, valijson::adapters::NlohmannJsonAdapter(document), nullptr);
}

TEST_F(Sink, Names) {
  for (const Format format :
       {Format::Text, Format::Concise, Format::Json, Format::Sarif, Format::Junit, Format::Github})
    EXPECT_EQ(formatFromName(nameOf(format)), format);
  EXPECT_EQ(formatFromName("yaml"), std::nullopt);
}

TEST_F(Sink, Concise) {
  EXPECT_EQ(writeConcise(report()), "cell 1/part.nc:2:1: error: `#510-#6` is 50% of a statement [missing-equals]\n");
  EXPECT_EQ(writeConcise(report(ShowSuppressed::Yes)),
            "cell 1/part.nc:1:3: info: a <comment> [plain-style] (allowed)\n"
            "cell 1/part.nc:2:1: error: `#510-#6` is 50% of a statement [missing-equals]\n");
}

TEST_F(Sink, TextHasRuleCaretsAndPlace) {
  const std::string text = writeText(report());
  EXPECT_NE(text.find("[missing-equals]"), std::string::npos);
  EXPECT_NE(text.find("cell 1/part.nc:2:1"), std::string::npos);
  EXPECT_NE(text.find("path: line 1 `"), std::string::npos);
  EXPECT_NE(text.find("^^^^^^^"), std::string::npos);
  EXPECT_EQ(text.find("plain-style"), std::string::npos);
}

TEST_F(Sink, AnotherLanguageIsRefusedInOneLine) {
  result_.files[0].foreign = "Sinumerik";
  result_.files[0].reasons = {"a file named `.mpf`"};
  result_.files[0].findings[1].diagnostic.message = "this is Sinumerik, which Feedhold does not read";
  EXPECT_EQ(writeText(report()), "error: cell 1/part.nc: this is Sinumerik, which Feedhold does not read (a file named "
                                 "`.mpf`) [missing-equals]\n\n");
  const Json document = Json::parse(writeJson(report()));
  EXPECT_TRUE(document["files"].empty());
  EXPECT_EQ(document["skipped"][0],
            Json::parse(R"({"path": "cell 1/part.nc", "reason": "Sinumerik", "kind": "refused"})"));
}

TEST_F(Sink, Summary) {
  EXPECT_EQ(summary(report()), "1 error in 1 file, 1 allowed, 1 file refused, 1 file not checked\n"
                               "1 finding has a fix that needs your review: --diff --unsafe-fixes shows it\n"
                               "dialect fanuc-30i: 1 by its text\n"
                               "to choose another dialect, set `dialect` in feedhold.toml or give --dialect\n");
  EXPECT_EQ(skippedFiles(result_.skipped), "refused picture.nc: a binary file\n");
  EXPECT_EQ(statistics(report(ShowSuppressed::Yes)), "      1 missing-equals\n      1 plain-style\n");
}

TEST_F(Sink, SummaryNamesTheFilesOfEachDialect) {
  CheckedFile other = result_.files[0];
  other.path = "bore.ngc";
  other.dialect = "linuxcnc";
  other.choice = DialectChoice::Config;
  result_.files.push_back(other);
  EXPECT_NE(summary(report()).find("dialect fanuc-30i: 1 by its text (cell 1/part.nc)\n"
                                   "dialect linuxcnc: 1 by feedhold.toml (bore.ngc)\n"),
            std::string::npos);
}

TEST_F(Sink, SummarySetsApartWhatShowsNoControl) {
  CheckedFile other = result_.files[0];
  other.path = "turn.nc";
  other.choice = DialectChoice::Fallback;
  result_.files.push_back(other);
  EXPECT_NE(summary(report()).find("\n1 file does not show which control it is for, and was checked as fanuc-30i "
                                   "(turn.nc): set the right one\ndialect fanuc-30i: 1 by its text\n"),
            std::string::npos);
}

TEST_F(Sink, RefusalsStandBehindTheFindings) {
  CheckedFile other = result_.files[0];
  result_.files[0].foreign = "Sinumerik";
  other.path = "turn.nc";
  other.findings[1].diagnostic.message = "a broken block";
  result_.files.push_back(other);
  const std::string text = writeText(report());
  EXPECT_LT(text.find("error: a broken block"), text.find("error: cell 1/part.nc"));
  EXPECT_EQ(summary(report()).find("2 errors in 1 file"), summary(report()).find("2 errors"))
      << "a refusal is an error, as in the other formats";
}

TEST_F(Sink, FindingsBelowTheSeverityAreCountedOnly) {
  result_.files[0].minSeverity = Severity::Warning;
  result_.files[0].findings[0].suppressed = false;
  EXPECT_EQ(writeConcise(report()), "cell 1/part.nc:2:1: error: `#510-#6` is 50% of a statement [missing-equals]\n");
  EXPECT_NE(summary(report()).find("\n1 finding of lower severity is not shown: --severity info shows it\n"),
            std::string::npos);
  const Json document = Json::parse(writeJson(report()));
  EXPECT_EQ(document["findings"].size(), 1U);
  EXPECT_EQ(document["hidden"], 1);
  EXPECT_TRUE(followsSchema(document));
}

TEST_F(Sink, Json) {
  const Json document = Json::parse(writeJson(report()));
  EXPECT_EQ(document["version"], 2);
  ASSERT_EQ(document["findings"].size(), 1U);
  EXPECT_EQ(document["findings"][0], Json::parse(R"({
    "path": "cell 1/part.nc", "line": 2, "column": 1, "endLine": 2, "endColumn": 8, "rule": "missing-equals",
    "severity": "error", "message": "`#510-#6` is 50% of a statement", "fingerprint": "0123456789abcdef",
    "flow": [{"path": "cell 1/part.nc", "line": 1, "column": 1, "endLine": 1, "endColumn": 9,
             "message": "the condition holds"}],
    "notes": ["the control stops"],
    "fixes": [{"title": "write `=`", "safety": "needs-review",
               "edits": [{"line": 2, "column": 5, "endLine": 2, "endColumn": 6, "replacement": "="}]}]})"));
  EXPECT_EQ(document["skipped"],
            Json::parse(R"([{"path": "picture.nc", "reason": "a binary file", "kind": "refused"}])"));
  EXPECT_EQ(document["files"],
            Json::parse(R"([{"path": "cell 1/part.nc", "dialect": "fanuc-30i", "chosenBy": "guess", "reasons": []}])"));
  EXPECT_EQ(document["errors"], Json::parse(R"([{"path": "gone.nc", "message": "no such file"}])"));
}

TEST_F(Sink, JsonFollowsItsSchema) {
  const Json document = Json::parse(writeJson(report(ShowSuppressed::Yes)));
  EXPECT_TRUE(followsSchema(document));
  for (const char *key : {"rule", "line", "fingerprint", "flow", "fixes"}) {
    Json broken = document;
    broken["findings"][0].erase(key);
    EXPECT_FALSE(followsSchema(broken)) << key;
  }
  Json broken = document;
  broken["findings"][0]["severity"] = "fatal";
  EXPECT_FALSE(followsSchema(broken));
}

TEST_F(Sink, Sarif) {
  const Json document = Json::parse(writeSarif(report(ShowSuppressed::Yes)));
  EXPECT_EQ(document["version"], "2.1.0");
  const Json &run = document["runs"][0];
  EXPECT_EQ(run["columnKind"], "utf16CodeUnits");
  EXPECT_EQ(run["originalUriBaseIds"]["%SRCROOT%"]["uri"], "file:///shop/");
  EXPECT_EQ(run["invocations"][0]["exitCode"], 2);
  EXPECT_EQ(run["invocations"][0]["toolExecutionNotifications"].size(), 2U);
  EXPECT_EQ(run["tool"]["driver"]["rules"][0]["help"]["markdown"], "# missing-equals\n");
  ASSERT_EQ(run["results"].size(), 2U);
  EXPECT_EQ(run["results"][0]["suppressions"], Json::parse(R"([{"kind": "inSource"}])"));
  const Json &slip = run["results"][1];
  EXPECT_EQ(slip["ruleIndex"], 0);
  EXPECT_EQ(slip["level"], "error");
  EXPECT_EQ(slip["message"]["text"], "`#510-#6` is 50% of a statement\nthe control stops");
  EXPECT_EQ(slip["locations"][0]["physicalLocation"],
            Json::parse(R"({"artifactLocation": {"uri": "cell%201/part.nc", "uriBaseId": "%SRCROOT%"},
                            "region": {"startLine": 2, "startColumn": 1, "endLine": 2, "endColumn": 8}})"));
  EXPECT_EQ(slip["relatedLocations"][0]["message"]["text"], "in this program");
  const Json &flow = slip["codeFlows"][0]["threadFlows"][0]["locations"];
  ASSERT_EQ(flow.size(), 2U); // the finding itself is the last step
  EXPECT_EQ(flow[0]["location"]["message"]["text"], "the condition holds");
  EXPECT_EQ(flow[0]["location"]["physicalLocation"]["region"]["startLine"], 1);
  EXPECT_EQ(flow[1]["location"]["physicalLocation"]["region"]["startLine"], 2);
  EXPECT_EQ(slip["fixes"][0]["artifactChanges"][0]["replacements"][0]["insertedContent"]["text"], "=");
}

TEST_F(Sink, SarifPathsOutsideOfTheRootAreAbsolute) {
  result_.files[0].path = "/other/part.nc";
  const Json document = Json::parse(writeSarif(report()));
  EXPECT_EQ(document["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"],
            Json::parse(R"({"uri": "file:///other/part.nc"})"));
}

TEST_F(Sink, Junit) {
  const std::string text = writeJunit(report(ShowSuppressed::Yes));
  EXPECT_NE(text.find("<testsuite name=\"cell 1/part.nc\" tests=\"2\" failures=\"1\" errors=\"0\">"),
            std::string::npos);
  EXPECT_NE(text.find("<skipped message=\"allowed: a &lt;comment&gt;\"/>"), std::string::npos);
  EXPECT_NE(text.find("<failure type=\"error\" message=\"`#510-#6` is 50% of a statement\">"), std::string::npos);
  EXPECT_NE(text.find("<error message=\"no such file\"/>"), std::string::npos);
}

TEST_F(Sink, JunitReplacesWhatXmlCannotHold) {
  result_.errors = {{"a\x01\xff.nc", "x"}};
  EXPECT_NE(writeJunit(report()).find("name=\"a\xef\xbf\xbd\xef\xbf\xbd.nc\""), std::string::npos);
}

TEST_F(Sink, Github) {
  EXPECT_EQ(writeGithub(report()),
            "::error file=cell 1/part.nc,line=2,endLine=2,col=1,endColumn=8,title=missing-equals::"
            "`#510-#6` is 50%25 of a statement%0Athe control stops\n"
            "::error file=gone.nc::no such file\n");
}

} // namespace
} // namespace feedhold
