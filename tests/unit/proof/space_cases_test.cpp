// Movements of which nothing may be claimed: where a control goes is not known in them.
#include "dialects/registry.h"
#include "language/contract/contract.h"
#include "language/parse/parse.h"
#include "proof/prove/prove.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

constexpr std::string_view kModes = "( @MODAL G17 G21 G40 G90 G94 )";

/// What is told of the regions of a block, the last of them; absent: nothing.
std::optional<Verdict> verdictOn(std::string_view block, std::string_view body, std::string_view modes = kModes) {
  const std::string contract = "( @START X0. Y0. Z10. )\n( @TOOL FLAT RADIUS 5. )\n"
                               "( @KEEPIN POCKET BOX X-20..20 Y-20..20 )\n";
  const Dialect &dialect = *findDialect(allDialects(), "fanuc-30i");
  const SourceFile source =
      SourceFile::fromText("t.nc", "O9001\n" + std::string(modes) + "\n" + contract + std::string(body));
  const SyntaxTree tree = parse(source, dialect);
  const ProgramModel model = resolve(source, tree, dialect);
  const ProgramSet set({{FileId(0), &source, &tree, &model, &dialect}}, CallGraph({{FileId(0), "", "", &model}}));
  const FileContracts contracts = readContracts(source, tree, model, dialect);
  const Callee main{FileId(0), set.file(FileId(0)).cfg.entryOf(ProgramId(0)), ProgramId(0)};
  EXPECT_TRUE(contracts.of(main.program)->isSound);
  std::optional<Verdict> verdict;
  for (const Obligation &each :
       prove(set, main, &contracts, {.only = {ObligationKind::KeepIn, ObligationKind::KeepOut}}).obligations)
    if (source.text(tree.blocks[set.node(each.place).block].span()) == block)
      verdict = each.verdict;
  return verdict;
}

TEST(SpaceCases, WhatStaysInIsProved) {
  EXPECT_EQ(verdictOn("G01 X10.", "G01 X10. F100.\nG01 X-10.\nG01 X10.\nM99\n"), Verdict::Proved);
}

TEST(SpaceCases, BlockThatCouldNotBeRead) {
  EXPECT_EQ(verdictOn("G01 X[[1.", "G01 X10. F100.\nG01 X[[1.\nM99\n"), Verdict::Unknown);
}

TEST(SpaceCases, CodeThatTheControlDoesNotHave) {
  EXPECT_EQ(verdictOn("G187", "G01 X10. F100.\nG187\nM99\n"), Verdict::Unknown);
}

TEST(SpaceCases, OffsetWhoseNumberIsNotKnown) {
  constexpr std::string_view written =
      "( @PARAM #1 SLOT 5241..5242 )\n#[#1]=100.\nG01 X10. Y10. F100.\nG01 X0. Y0.\nM99\n";
  EXPECT_EQ(verdictOn("G01 X0. Y0.", written), Verdict::Unknown);
  constexpr std::string_view data =
      "( @PARAM #1 WHICH 2..3 )\nG10 L2 P#1 X100.\nG01 X10. Y10. F100.\nG01 X0. Y0.\nM99\n";
  EXPECT_EQ(verdictOn("G01 X0. Y0.", data), Verdict::Unknown);
}

TEST(SpaceCases, AdditionalWorkOffset) {
  constexpr std::string_view body = "G54.1 P2\nG01 X10. Y10. F100.\nG01 X0. Y0.\nM99\n";
  EXPECT_EQ(verdictOn("G01 X0. Y0.", body, "( @MODAL G17 G21 G40 G54.1 G90 G94 )"), Verdict::Unknown);
}

/// The tool comes from beside the path, inside of the region.
TEST(SpaceCases, EndOfCutterCompensation) {
  constexpr std::string_view body = "G01 X0. F100.\nG41 D1 X14.\nY10.\nG40 X5.\nX0.\nM99\n";
  EXPECT_EQ(verdictOn("G01 X0. F100.", body), Verdict::Proved);
  for (const std::string_view block : {"G41 D1 X14.", "Y10.", "G40 X5.", "X0."})
    EXPECT_EQ(verdictOn(block, body), Verdict::Proved) << block;
}

/// The same from outside of the region: a run shows it.
TEST(SpaceCases, CompensatedToolOutside) {
  constexpr std::string_view body = "G01 X0. F100.\nG42 D1 X14.\nY10.\nG40 X5.\nX0.\nM99\n";
  EXPECT_EQ(verdictOn("G01 X0. F100.", body), Verdict::Proved);
  for (const std::string_view block : {"G42 D1 X14.", "Y10.", "G40 X5."})
    EXPECT_EQ(verdictOn(block, body), Verdict::Refuted) << block;
  EXPECT_EQ(verdictOn("X0.", body), Verdict::Proved);
}

/// A block without a movement in the plane does not end it.
TEST(SpaceCases, EndOfCutterCompensationInALaterBlock) {
  constexpr std::string_view body = "G42 D1 G01 X14. F100.\nG40\nZ20.\nX5.\nX0.\nM99\n";
  EXPECT_EQ(verdictOn("Z20.", body), Verdict::Unknown);
  EXPECT_EQ(verdictOn("X5.", body), Verdict::Unknown);
  EXPECT_EQ(verdictOn("X0.", body), Verdict::Proved);
}

/// By what is written, the tool stands in the middle of the clamp or beside it.
TEST(SpaceCases, PolygonWhoseSidesCross) {
  const auto verdict = [](std::string corners) {
    return verdictOn("G01 X1.", "( @KEEPOUT CLAMP POLYGON " + corners + " Z-50..50 )\nG01 X1. F100.\nG01 X1.\nM99\n");
  };
  EXPECT_EQ(verdict("X30 Y-9 / X50 Y-9 / X50 Y9 / X40 Y9 / X40 Y5 / X30 Y5"), Verdict::Proved);
  EXPECT_EQ(verdict("X30 Y-9 / X50 Y-9 / X50 Y9 / X30 Y9 / X30 Y-9"), Verdict::Proved);
  EXPECT_EQ(verdict("X30 Y-9 / X50 Y-9 / X50 Y9 / X30 Y-5 / X30 Y9"), Verdict::Unknown);
  EXPECT_EQ(verdict("X-30 Y-30 / X30 Y-30 / X30 Y30 / X-30 Y30 / X-30 Y-30 / X30 Y-30 / X30 Y30 / X-30 Y30"),
            Verdict::Unknown);
}

} // namespace
} // namespace feedhold::prove
