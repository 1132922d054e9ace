// What stays the same from one loading of a folder to the next is not read again; what does not, is.
#include "findings/project/file_store.h"

#include "dialects/registry.h"
#include "findings/project/project.h"
#include "rules/registry.h"

#include <fstream>
#include <gtest/gtest.h>

namespace feedhold {
namespace {

namespace fs = std::filesystem;

class FileStoreTest : public testing::Test {
protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              (std::string("feedhold-memory-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("O1.nc", "%\nO1\nM98 P2\nM30\n%\n");
    write("O2.nc", "%\nO2\n#500=1\nM99\n%\n");
    write("O3.nc", "%\nO3\nM99\n%\n");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string &name, std::string_view text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  std::unique_ptr<const Project> load(std::shared_ptr<const OpenTexts> open = std::make_shared<const OpenTexts>(),
                                      FileStore *store = nullptr) {
    const KnownNames known{allDialects(), allRules()};
    auto loaded = loadProject(
        {.path = (folder_ / "O1.nc").generic_string(), .open = std::move(open), .store = store ? store : &store_},
        known);
    return loaded ? loaded.take() : nullptr;
  }

  /// Which of the three files are the very same objects.
  static std::vector<bool> kept(const Project &before, const Project &after) {
    std::vector<bool> same;
    for (std::size_t i = 0; i < after.files.size(); ++i)
      same.push_back(before.files.at(i) == after.files[i]);
    return same;
  }

  fs::path folder_;
  FileStore store_{FileStore::Lifetime::Server};
};

TEST_F(FileStoreTest, OnlyWhatChangedIsRead) {
  const auto first = load(), second = load();
  EXPECT_EQ(kept(*first, *second), std::vector({true, true, true}));
  write("O2.nc", "%\nO2\n#501=1\nM99\n%\n");
  const auto third = load();
  EXPECT_EQ(kept(*second, *third), std::vector({true, false, true}));
  EXPECT_NE(third->file(FileId(1)).source.text().find("#501"), std::string_view::npos);
}

TEST_F(FileStoreTest, AnEditorsTextCounts) {
  const auto first = load();
  auto open = std::make_shared<OpenTexts>();
  (*open)[folder_ / "O3.nc"] = std::make_shared<const std::string>("%\nO3\n#1=2\nM99\n%\n");
  const auto second = load(open);
  EXPECT_EQ(kept(*first, *second), std::vector({true, true, false}));
  EXPECT_EQ(kept(*second, *load(open)), std::vector({true, true, true}));
}

TEST_F(FileStoreTest, ContractsAreReadWithTheirPrograms) {
  const auto first = load();
  write("O2.contract", "@REQUIRE #500 GT 0\n");
  const auto second = load();
  EXPECT_EQ(kept(*first, *second), std::vector({true, false, true}));
  EXPECT_EQ(second->file(FileId(1)).contracts.contracts.size(), 1U);
  write("O2.contract", "@REQUIRE #500 GT 1\n");
  EXPECT_EQ(kept(*second, *load()), std::vector({true, false, true}));
}

TEST_F(FileStoreTest, AnotherControlReadsAnew) {
  const auto first = load();
  write("feedhold.toml", "dialect = \"mitsubishi-m700\"\n");
  const auto second = load();
  ASSERT_NE(first->dialect().id, second->dialect().id);
  EXPECT_EQ(kept(*first, *second), std::vector({false, false, false}));
  fs::remove(folder_ / "feedhold.toml");
  EXPECT_EQ(kept(*first, *load()), std::vector({true, true, true}));
}

TEST_F(FileStoreTest, ARunReadsAFileOnce) {
  FileStore store(FileStore::Lifetime::Run);
  const auto first = load(nullptr, &store);
  write("O2.nc", "%\nO2\n#501=1\nM99\n%\n");
  write("O4.nc", "%\nO4\nM99\n%\n");
  const auto second = load(nullptr, &store);
  EXPECT_EQ(second->files.size(), 3U); // the folder, too, is listed once
  EXPECT_EQ(kept(*first, *second), std::vector({true, true, true}));
}

} // namespace
} // namespace feedhold
