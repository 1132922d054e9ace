// Files with contracts beside a program: which are found, and how their findings come out.
#include "dialects/registry.h"
#include "findings/project/project.h"
#include "findings/session/session.h"
#include "rules/registry.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace feedhold {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test.
class Sidecars : public testing::Test {
protected:
  void SetUp() override {
    std::string path = (fs::temp_directory_path() / "feedhold-sidecars-XXXXXX").string();
    ASSERT_NE(mkdtemp(path.data()), nullptr);
    folder_ = path;
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string &name, std::string_view text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  CheckOptions options() const {
    CheckOptions options;
    options.paths = {(folder_ / "part.nc").string()};
    options.select = {"contract"};
    options.config.source = ConfigSource::None;
    options.jobs = 1;
    return options;
  }
  static KnownNames known() { return {allDialects(), allRules()}; }

  fs::path folder_;
};

TEST_F(Sidecars, AreCheckedFilesOfTheirOwnWhenThereIsSomethingToSay) {
  write("part.nc", "O9100\n#1=#21\nM99\n");
  write("O9100.contract", "@PARAM #21 0..5\n");
  EXPECT_EQ(check(options(), known()).files.size(), 1u);
  write("O9100.contract", "@PARAM #21 5..0\n\n@PARM #21 5..0\n@PARM #21 5..0\n");
  const CheckResult result = check(options(), known());
  ASSERT_EQ(result.files.size(), 2u);
  const CheckedFile &sidecar = result.files[1];
  EXPECT_EQ(fs::path(sidecar.path), folder_ / "O9100.contract");
  ASSERT_EQ(sidecar.findings.size(), 3u);
  EXPECT_EQ(sidecar.findings[0].rule->name, "empty-contract-range");
  EXPECT_NE(sidecar.findings[1].fingerprint, sidecar.findings[2].fingerprint);
  EXPECT_TRUE(anyFails(result));
}

TEST_F(Sidecars, EachNameIsReadOnce) {
  write("part.nc", "O0140\n#1=#21\nM99\n");
  write("O0140.contract", "@REQUIRE #21 GT 1\n");
  write("O140.contract", "@REQUIRE #21 GT 2\n");
  write("part.contract", "@REQUIRE #21 GT 3\n");
  write("part.nc.contract", "@REQUIRE #21 GT 4\n");
  write("O9999.contract", "@REQUIRE #21 GT 5\n");
  const auto programs = loadProject({.path = (folder_ / "part.nc").string(), .config = {ConfigSource::None}}, known());
  ASSERT_TRUE(programs);
  const FileContracts &contracts = programs.value()->files.front()->contracts;
  ASSERT_NE(contracts.of(ProgramId(0)), nullptr);
  EXPECT_EQ(contracts.of(ProgramId(0))->requirements.size(), 4u);
}

TEST_F(Sidecars, OneThatCannotBeReadIsAnError) {
  write("part.nc", "O9100\n#1=#21\nM99\n");
  fs::create_directory(folder_ / "part.contract");
  const CheckResult result = check(options(), known());
  ASSERT_EQ(result.files.size(), 2u);
  EXPECT_EQ(result.files[1].findings.front().rule->name, "malformed-contract-clause");
}

TEST_F(Sidecars, AreNotRepaired) {
  write("part.nc", "O9100\n(@PARM #21 0..5)\n#1=#21\nM99\n");
  write("part.contract", "@PARM #21 0..5\n");
  const FixResult fixed = fix(options(), FixKind::All, known());
  ASSERT_EQ(fixed.files.size(), 1u);
  EXPECT_EQ(fixed.files.front().after, "O9100\n(@PARAM #21 0..5)\n#1=#21\nM99\n");
}

} // namespace
} // namespace feedhold
