// Whole runs on files in a folder of their own: discovery, settings, fingerprints, repairs.
#include "dialects/registry.h"
#include "findings/session/session.h"
#include "rules/registry.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace feedhold {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kProgramWithSlip = "%\nO1001(SLIP)\nN10 #510-1.5\nM30\n%\n";

class Session : public testing::Test {
protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("feedhold-session-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string &name, std::string_view text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string read(const std::string &name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return text.str();
  }
  CheckOptions options(const std::string &path = ".") const {
    CheckOptions result;
    result.paths = {(folder_ / path).lexically_normal().string()};
    return result;
  }
  CheckResult run(const CheckOptions &options) const { return check(options, known()); }
  CheckResult run() const { return run(options()); }
  static KnownNames known() { return {allDialects(), allRules()}; }

  /// Paths from the folder of the test.
  std::vector<std::string> names(const CheckResult &result) const {
    std::vector<std::string> found;
    for (const CheckedFile &file : result.files)
      found.push_back(fs::path(file.path).lexically_relative(folder_).generic_string());
    return found;
  }
  std::string onlyFingerprint() const {
    const CheckResult result = run();
    return result.files.size() == 1 && result.files[0].findings.size() == 1 ? result.files[0].findings[0].fingerprint
                                                                            : "";
  }

  fs::path folder_;
};

TEST_F(Session, FoldersAreWalkedByNameAndContent) {
  write("b/O1001", kProgramWithSlip);
  write("a/part.NC", kProgramWithSlip);
  write("a/part.txt", kProgramWithSlip);
  write("a/notes.txt", "the coolant must be changed every week\nand the filter too\n");
  write("a/readme.md", kProgramWithSlip);
  write(".git/part.nc", kProgramWithSlip);
  const CheckResult result = run();
  EXPECT_EQ(names(result), (std::vector<std::string>{"a/part.NC", "a/part.txt", "b/O1001"}));
  ASSERT_EQ(result.skipped.size(), 2U);
  EXPECT_TRUE(result.skipped[0].path.ends_with("a/notes.txt"));
  EXPECT_EQ(result.skipped[0].kind, SkipKind::NoProgram);
  EXPECT_TRUE(result.skipped[1].path.ends_with("a/readme.md"));
  EXPECT_EQ(result.skipped[1].reason, "a `.md` file");
  EXPECT_TRUE(result.errors.empty());
}

TEST_F(Session, NamedFilesAreTakenWhateverTheirExtension) {
  write("part.csv", kProgramWithSlip);
  EXPECT_EQ(run().errors.size(), 1U); // no program in the folder
  CheckOptions named = options("part.csv");
  named.control.dialect = "fanuc-30i";
  EXPECT_EQ(names(run(named)), (std::vector<std::string>{"part.csv"}));
}

TEST_F(Session, AnyExtensionIsTakenByContent) {
  for (const char *name :
       {"a.gcode", "a.macro", "a.hom", "a.rc", "a.ALL", "a.mc12", "a.SSB", "a.LIB", "a.ptp", "O1 OLD"})
    write(name, kProgramWithSlip);
  write("tools.tdb", "T1 P1 D10.5\nT2 P2 D6.0\n"); // words, but no code
  write("positions.dat", "0.5 1.5 2.5\n");
  write("picture.dat2", std::string("\x01\x02\x03\x04\x05\x06\x07\x08", 8));
  const CheckResult result = run();
  EXPECT_EQ(result.files.size(), 10U);
  ASSERT_EQ(result.skipped.size(), 3U);
  for (const SkippedFile &skipped : result.skipped)
    EXPECT_EQ(skipped.kind, SkipKind::NoProgram);
}

TEST_F(Session, ExcludeAndInclude) {
  write("feedhold.toml", "exclude = [\"old/\"]\ninclude = [\"*.xyz\"]\n");
  write("old/part.nc", kProgramWithSlip);
  write("new/part.xyz", kProgramWithSlip);
  EXPECT_EQ(names(run()), (std::vector<std::string>{"new/part.xyz"}));
}

TEST_F(Session, TheNearestConfigurationCounts) {
  write("feedhold.toml", "ignore = [\"missing-equals\"]\n");
  write("part.nc", kProgramWithSlip);
  write("strict/feedhold.toml", "dialect = \"fanuc-0i\"\n[severity]\nmissing-equals = \"info\"\n");
  write("strict/part.nc", kProgramWithSlip);
  const CheckResult result = run();
  ASSERT_EQ(result.files.size(), 2U);
  EXPECT_TRUE(result.files[0].findings.empty());
  ASSERT_EQ(result.files[1].findings.size(), 1U);
  EXPECT_EQ(result.files[1].findings[0].severity, Severity::Info);
  EXPECT_EQ(result.files[1].dialect, "fanuc-0i");
  EXPECT_EQ(result.files[1].choice, DialectChoice::Config);
  EXPECT_FALSE(anyFails(result));
}

TEST_F(Session, AConfigurationWithErrorsStopsOnlyItsFiles) {
  write("bad/feedhold.toml", "dialct = \"x\"\n");
  write("bad/part.nc", kProgramWithSlip);
  write("good/part.nc", kProgramWithSlip);
  const CheckResult result = run();
  EXPECT_EQ(names(result), (std::vector<std::string>{"good/part.nc"}));
  ASSERT_EQ(result.errors.size(), 1U);
  EXPECT_TRUE(result.errors[0].path.ends_with("feedhold.toml:1:1"));
}

TEST_F(Session, SettingsByPattern) {
  write("feedhold.toml", "[[files]]\npath = \"lathe/**\"\ndialect = \"haas-ngc\"\nignore = [\"expression\"]\n");
  write("lathe/part.nc", kProgramWithSlip);
  write("mill/part.nc", kProgramWithSlip);
  const CheckResult result = run();
  ASSERT_EQ(result.files.size(), 2U);
  EXPECT_EQ(result.files[0].dialect, "haas-ngc");
  EXPECT_TRUE(result.files[0].findings.empty());
  EXPECT_EQ(result.files[1].findings.size(), 1U);
}

TEST_F(Session, TheFolderVotesWhateverIsChecked) {
  write("cell/O1.nc", "O1\n#1=#1+1\nM99\n");
  write("cell/O2.nc", "%\nO00012\nM97 P1\nG103 P1\nM30\nN1 M99\n%\n");
  const CheckResult whole = run();
  const CheckResult alone = run(options("cell/O1.nc"));
  ASSERT_EQ(whole.files.size(), 2U);
  ASSERT_EQ(alone.files.size(), 1U);
  EXPECT_EQ(whole.files[0].dialect, "haas-ngc");
  EXPECT_EQ(whole.files[0].choice, DialectChoice::FolderVote);
  EXPECT_EQ(whole.files[1].choice, DialectChoice::Guess);
  EXPECT_EQ(alone.files[0].dialect, "haas-ngc");
}

TEST_F(Session, CallsFindWhatIsOnTheMachine) {
  const auto missing = [this] {
    CheckOptions asked = options();
    asked.select = {"program-not-found"};
    const CheckResult result = run(asked);
    std::size_t found = 0;
    for (const CheckedFile &file : result.files)
      found += file.findings.size();
    return found;
  };
  write("cell1/O1000.nc", "O1000\nM98P2000\nM30\n");
  write("cell2/O2000.nc", "O2000\nM99\n"); // another machine
  EXPECT_EQ(missing(), 1U);
  write("cell1/parts/O2000.nc", "O2000\nM99\n");
  EXPECT_EQ(missing(), 0U);
  fs::remove_all(folder_ / "cell1/parts");
  write("Sub_Programs/O2000.nc", "O2000\nM99\n");
  EXPECT_EQ(missing(), 0U);
}

TEST_F(Session, FingerprintsOutliveEditsElsewhere) {
  write("part.nc", kProgramWithSlip);
  const std::string before = onlyFingerprint();
  EXPECT_EQ(before.size(), 16U);
  write("part.nc", "%\nO1001(SLIP)\n(NEW)\nN20  #510 - 1.5\nM30\n%\n");
  EXPECT_EQ(onlyFingerprint(), before);
  write("part.nc", "%\nO1001(SLIP)\nN10 #511-1.5\nM30\n%\n");
  EXPECT_NE(onlyFingerprint(), before);
  write("part.nc", "%\nO1002(SLIP)\nN10 #510-1.5\nM30\n%\n");
  EXPECT_NE(onlyFingerprint(), before);
}

TEST_F(Session, EqualFindingsHaveDifferentFingerprints) {
  write("part.nc", "O1\n#510-1.5\n#510-1.5\nM30\n");
  const CheckResult result = run();
  ASSERT_EQ(result.files[0].findings.size(), 2U);
  EXPECT_NE(result.files[0].findings[0].fingerprint, result.files[0].findings[1].fingerprint);
}

TEST_F(Session, ForeignLanguageIsOneFinding) {
  std::string text = "0 BEGIN PGM TEST MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n";
  for (int line = 2; line < 100; ++line)
    text += std::to_string(line) + " L X+1 Y+0 R0 FMAX M3\n";
  write("part.h", text + "100 END PGM TEST MM\n");
  const CheckResult result = run();
  ASSERT_EQ(result.files.size(), 1U);
  ASSERT_EQ(result.files[0].findings.size(), 1U);
  EXPECT_EQ(result.files[0].findings[0].rule->name, "foreign-language");
}

TEST_F(Session, UnsafeFixesOnlyWhenAskedFor) {
  write("part.nc", kProgramWithSlip);
  EXPECT_TRUE(fix(options(), FixKind::Safe, known()).files.empty());
  const FixResult all = fix(options(), FixKind::All, known());
  ASSERT_EQ(all.files.size(), 1U);
  EXPECT_EQ(all.files[0].before, kProgramWithSlip);
  EXPECT_EQ(all.files[0].after, "%\nO1001(SLIP)\nN10 #510=1.5\nM30\n%\n");
  EXPECT_EQ(all.files[0].fixes, 1U);
  EXPECT_TRUE(all.remaining.files[0].findings.empty());
  EXPECT_EQ(read("part.nc"), kProgramWithSlip);
}

TEST_F(Session, WritingKeepsThePermissionsAndLeavesNothingBehind) {
  write("part.nc", kProgramWithSlip);
  fs::permissions(folder_ / "part.nc", fs::perms::owner_all);
  const FixResult fixed = fix(options(), FixKind::All, known());
  EXPECT_TRUE(writeFixes(fixed.files).empty());
  EXPECT_EQ(read("part.nc"), "%\nO1001(SLIP)\nN10 #510=1.5\nM30\n%\n");
  EXPECT_EQ(fs::status(folder_ / "part.nc").permissions(), fs::perms::owner_all);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(Session, BinaryAndEmptyFilesDoNotStopTheOthers) {
  write("part.nc", kProgramWithSlip);
  write("empty.nc", "");
  write("picture.nc", std::string("\x01\x02\x03\x04\x05\x06\x07\x08", 8));
  const CheckResult result = run();
  EXPECT_EQ(names(result), (std::vector<std::string>{"part.nc"}));
  ASSERT_EQ(result.skipped.size(), 2U);
  EXPECT_EQ(result.skipped[0].kind, SkipKind::NoProgram);
  EXPECT_EQ(result.skipped[0].reason, "the file is empty");
  EXPECT_EQ(result.skipped[1].reason, "a binary file");
}

} // namespace
} // namespace feedhold
