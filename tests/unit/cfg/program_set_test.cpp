// Where calls lead and what names of variables stand for, over several files.
#include "dialects/registry.h"
#include "language/parse/parse.h"
#include "meaning/cfg/program_set.h"

#include <gtest/gtest.h>

#include <deque>

namespace feedhold {
namespace {

/// A set of files with all that must outlive it.
class Fixture {
public:
  Fixture(std::string_view dialectId, const std::vector<std::string> &texts) : dialect_(dialectFor(dialectId)) {
    std::vector<ModelledFile> modelled;
    std::vector<ProgramFile> files;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const SourceFile &source = sources_.emplace_back(SourceFile::fromText(std::to_string(i) + ".nc", texts[i]));
      const SyntaxTree &tree = trees_.emplace_back(parse(source, dialect_));
      const ProgramModel &model = models_.emplace_back(resolve(source, tree, dialect_));
      modelled.push_back({FileId(i), "", std::to_string(i), &model});
      files.push_back({FileId(i), &source, &tree, &model, &dialect_});
    }
    set.emplace(std::move(files), CallGraph(std::move(modelled)));
  }

  /// The line at which the n-th call of a file arrives; 0 when it leads nowhere known.
  std::uint32_t lineOfCallee(std::size_t file, std::size_t call) const {
    const std::optional<Callee> callee = set->callee(FileId(file), CallId(call));
    if (!callee)
      return 0;
    const std::size_t to = callee->file.index();
    const BlockId block = set->node({callee->file, callee->entry}).block;
    return sources_[to].lineOf(trees_[to].blocks[block].begin);
  }
  std::optional<std::uint32_t> variable(std::size_t file, std::string_view name) const {
    const auto at = static_cast<std::uint32_t>(sources_[file].text().find(name));
    return set->variableOf(FileId(file), {at, at + static_cast<std::uint32_t>(name.size())});
  }

  std::optional<ProgramSet> set;

private:
  static const Dialect &dialectFor(std::string_view id) { return *findDialect(allDialects(), id); }

  const Dialect &dialect_;
  std::deque<SourceFile> sources_;
  std::deque<SyntaxTree> trees_;
  std::deque<ProgramModel> models_;
};

TEST(ProgramSet, FindsCalleesInTheFileAndInOthers) {
  const Fixture fixture("fanuc-30i", {"O1\nG65P9010\nM98P2\nG65P#1\nM98P77\nM30\nO2\nM99\n", "O9010\nM99\n"});
  EXPECT_EQ(fixture.lineOfCallee(0, 0), 1u);
  EXPECT_EQ(fixture.set->callee(FileId(0), CallId(0))->file, FileId(1));
  EXPECT_EQ(fixture.lineOfCallee(0, 1), 7u);
  EXPECT_EQ(fixture.lineOfCallee(0, 2), 0u);
  EXPECT_EQ(fixture.lineOfCallee(0, 3), 0u);
  EXPECT_EQ(fixture.set->calleeOf(FileId(0), 9010)->file, FileId(1));
  EXPECT_FALSE(fixture.set->calleeOf(FileId(0), 9999));
}

TEST(ProgramSet, LocalCallsArriveAtTheirSequenceNumber) {
  const Fixture fixture("haas-ngc", {"O1\nM97P100\nM97P200\nM30\nN100G0X1.\nM99\n"});
  EXPECT_EQ(fixture.lineOfCallee(0, 0), 5u);
  EXPECT_EQ(fixture.lineOfCallee(0, 1), 0u);
}

TEST(ProgramSet, ReturnsOfOtherFilesEnterLoops) {
  const std::string caller = "O1\nG65P2\nWHILE[#1LT3]DO1\nN10#1=#1+1\nEND1\nM30\n";
  EXPECT_TRUE(Fixture("fanuc-30i", {caller, "O2\nM99\n"}).set->file(FileId(0)).cfg.gates.empty());
  EXPECT_EQ(Fixture("fanuc-30i", {caller, "O2\nM99P10\n"}).set->file(FileId(0)).cfg.gates.size(), 1u);
  EXPECT_TRUE(Fixture("fanuc-30i", {caller, "O2\nM99P20\n"}).set->file(FileId(0)).cfg.gates.empty());
}

TEST(ProgramSet, CountsUsesOfVariablesOverAllFiles) {
  const Fixture numbered("fanuc-30i", {"O1\n#500=1\n#501=#500\nM30\n", "O2\n#500=#501+#500\nM99\n"});
  EXPECT_EQ(numbered.set->usesOf(500).writes, 2u);
  EXPECT_EQ(numbered.set->usesOf(500).reads, 2u);
  EXPECT_EQ(numbered.set->usesOf(501).writes, 1u);
  EXPECT_EQ(numbered.set->usesOf(502).writes + numbered.set->usesOf(502).reads, 0u);
  EXPECT_EQ(numbered.set->unnumberedUses().writes + numbered.set->unnumberedUses().reads, 0u);
  EXPECT_FALSE(numbered.set->unnumberedUses().hasIndirect);

  const Fixture common("fanuc-30i", {"O1\n#500=1\nM30\n", "O2\n#[#1+500]=#[#2]\nM99\n"});
  EXPECT_EQ(common.set->unnumberedUses().writes, 1u);
  EXPECT_EQ(common.set->unnumberedUses().reads, 1u);
  EXPECT_TRUE(common.set->unnumberedUses().hasIndirect);
  EXPECT_TRUE(common.set->unnumberedUses().mayWriteCommon);

  const Fixture system("fanuc-30i", {"O1\n#[#1+5220]=1\n#1=#[#2]\nM30\n"});
  EXPECT_TRUE(system.set->unnumberedUses().hasIndirect);
  EXPECT_FALSE(system.set->unnumberedUses().mayWriteCommon);
}

TEST(ProgramSet, KnowsWhereSomethingIsIncremental) {
  const Fixture plain("fanuc-30i", {"O1\nG90G00X1.\nM30\n", "O2\nG01X1.\nM99\n"});
  EXPECT_FALSE(plain.set->mayBeIncrementalInFolderOf(FileId(0)));
  const Fixture other("fanuc-30i", {"O1\nG90G00X1.\nM30\n", "O2\nG91G01X1.\nM99\n"});
  EXPECT_TRUE(other.set->mayBeIncrementalInFolderOf(FileId(0)));
}

TEST(ProgramSet, KnowsNamesOfVariables) {
  const Fixture macro("fanuc-30i", {"O1\nSETVN 500[WIDTH,DEPTH]\n#1=[#DEPTH]\n#2=[#_ALM]\n#3=[#OTHER]\nM30\n"});
  EXPECT_EQ(macro.variable(0, "DEPTH"), 501u);
  EXPECT_EQ(macro.variable(0, "_ALM"), 3000u);
  EXPECT_EQ(macro.variable(0, "OTHER"), std::nullopt);

  const Fixture named("linuxcnc", {"#<depth>=1\n#<_all>=2\nM2\n", "#< Depth >=2\nM2\n"});
  const std::optional<std::uint32_t> depth = named.variable(0, "depth");
  ASSERT_TRUE(depth && *depth >= kFirstNamedVariable);
  EXPECT_EQ(named.variable(1, " Depth "), depth);
  EXPECT_EQ(named.set->nameOfVariable(*depth), "#<depth>");
  EXPECT_FALSE(named.set->isGlobalName(*depth));
  EXPECT_TRUE(named.set->isGlobalName(*named.variable(0, "_all")));
}

} // namespace
} // namespace feedhold
