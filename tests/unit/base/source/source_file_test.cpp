// SourceFile: opening, lines, columns.
#include "base/source/source_file.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace feedhold {
namespace {

using namespace std::string_literals;

/// The lines by the letter of the definition, one byte at a time.
struct NaiveLines {
  explicit NaiveLines(const std::string &text) {
    std::size_t begin = 0;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t length = endLength(text, at);
      if (length == 0) {
        ++at;
        continue;
      }
      add(begin, at, at + length);
      begin = at += length;
    }
    add(begin, text.size(), text.size() + 1);
  }

  static std::size_t endLength(const std::string &text, std::size_t at) {
    if (text[at] == '\n')
      return 1;
    const std::size_t behind = text.find_first_not_of('\r', at);
    if (behind != std::string::npos && behind != at && text[behind] == '\n')
      return behind - at + 1;
    return text[at] == '\r' ? 1 : 0;
  }

  void add(std::size_t begin, std::size_t end, std::size_t next) {
    spans.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
    for (std::size_t at = begin; at < next; ++at)
      lineOf.push_back(static_cast<std::uint32_t>(spans.size()));
  }

  std::vector<Span> spans;
  std::vector<std::uint32_t> lineOf; // for each byte and for the end of the text
};

void expectLinesOf(const std::string &text) {
  const NaiveLines naive(text);
  const SourceFile source = SourceFile::fromText("t.nc", text);
  ASSERT_EQ(source.lineCount(), naive.spans.size());
  for (std::uint32_t line = 1; line <= source.lineCount(); ++line)
    ASSERT_EQ(source.lineSpan(line), naive.spans[line - 1]) << "line " << line;
  for (std::uint32_t at = 0; at <= text.size(); ++at)
    ASSERT_EQ(source.lineOf(at), naive.lineOf[at]) << "byte " << at;
}

TEST(SourceFile, EveryKindOfLineEnd) {
  for (const std::string &text : {""s, "a"s, "\n"s, "a\nb"s, "a\nb\n"s, "a\r\nb\r\n"s, "a\r\r\nb"s, "a\rb\rc"s,
                                  "a\r\r\r\nb"s, "\r\r"s, "a\n\rb"s, "\n\n\r\r\n\r"s, "%\r\nO1\r\n\r\nM30\r\n%"s})
    expectLinesOf(text);
}

TEST(SourceFile, CountsLines) {
  const SourceFile source = SourceFile::fromText("t.nc", "a\r\r\nbc\rd\n");
  EXPECT_EQ(source.lineCount(), 4U);
  EXPECT_EQ(source.text(source.lineSpan(1)), "a");
  EXPECT_EQ(source.text(source.lineSpan(2)), "bc");
  EXPECT_EQ(source.text(source.lineSpan(3)), "d");
  EXPECT_EQ(source.text(source.lineSpan(4)), "");
  EXPECT_EQ(source.lineOf(3), 1U);
  EXPECT_EQ(source.lineOf(4), 2U);
  EXPECT_EQ(source.lineOf(9999), 4U);
}

TEST(SourceFile, LineEndsAcrossEveryBoundary) {
  // 64 and 256 are the strides of the index: each line end is moved over both.
  for (const std::string &end : {"\n"s, "\r\n"s, "\r\r\n"s, "\r"s, "\r\r\r\r\n"s})
    for (const std::size_t before : {61U, 62U, 63U, 64U, 252U, 253U, 254U, 255U, 256U}) {
      const std::string text = std::string(before, 'X') + end + "G1" + end + std::string(1100, 'Y') + end;
      expectLinesOf(text);
      if (HasFatalFailure())
        return;
    }
}

TEST(SourceFile, LongRunsOfReturns) {
  expectLinesOf(std::string(3000, '\r'));
  expectLinesOf(std::string(3000, '\r') + "\n");
  expectLinesOf("a" + std::string(2047, '\r') + "\nb");
}

TEST(SourceFile, LinesAreThoseOfTheDefinition) {
  EXPECT_TRUE(rc::check("the index agrees with the definition", [] {
    const auto piece =
        rc::gen::element("\n"s, "\r"s, "\r\n"s, "G1X2"s, "N10"s, std::string(60, 'Z'), std::string(7, '\r'));
    std::string text;
    for (const std::string &part : *rc::gen::container<std::vector<std::string>>(piece))
      text += part;
    const NaiveLines naive(text);
    const SourceFile source = SourceFile::fromText("t.nc", text);
    RC_ASSERT(source.lineCount() == naive.spans.size());
    for (std::uint32_t line = 1; line <= source.lineCount(); ++line)
      RC_ASSERT(source.lineSpan(line) == naive.spans[line - 1]);
    for (std::uint32_t at = 0; at <= text.size(); ++at)
      RC_ASSERT(source.lineOf(at) == naive.lineOf[at]);
  }));
}

TEST(SourceFile, ColumnsCountCharacters) {
  const SourceFile source = SourceFile::fromText("t.nc", "(Ø工🔧)X1\nY2");
  EXPECT_EQ(source.position(0), (Position{1, 1}));
  EXPECT_EQ(source.position(3), (Position{1, 3}));
  EXPECT_EQ(source.position(6), (Position{1, 4}));
  EXPECT_EQ(source.position(10), (Position{1, 5}));
  EXPECT_EQ(source.positionUtf16(10), (Position{1, 6}));
  EXPECT_EQ(source.position(8), (Position{1, 4})) << "inside of a character";
  EXPECT_EQ(source.position(15), (Position{2, 2}));
  EXPECT_EQ(source.position(16), (Position{2, 3}));
  EXPECT_EQ(source.position(999), (Position{2, 3}));
}

TEST(SourceFile, ColumnsInShiftJisAndLatin1) {
  const SourceFile japanese = SourceFile::fromText("t.nc", "M6\n(\x8d\x48\x8b\xef\x8c\xf0\x8a\xb7)X1");
  EXPECT_EQ(japanese.position(13), (Position{2, 7}));
  EXPECT_EQ(japanese.positionUtf16(13), (Position{2, 7}));
  EXPECT_EQ(japanese.utf8({3, 13}), "(工具交換)");
  const SourceFile german = SourceFile::fromText("t.nc", "(Fr\xe4sen)X1");
  EXPECT_EQ(german.position(8), (Position{1, 9}));
  EXPECT_EQ(german.utf8({0, 8}), "(Fräsen)");
}

TEST(SourceFile, AByteOrderMarkHasNoColumn) {
  const SourceFile source = SourceFile::fromText("t.nc", "\xef\xbb\xbfO1\nG1");
  EXPECT_EQ(source.position(0), (Position{1, 1}));
  EXPECT_EQ(source.position(3), (Position{1, 1}));
  EXPECT_EQ(source.position(4), (Position{1, 2}));
  EXPECT_EQ(source.position(6), (Position{2, 1}));
}

TEST(SourceFile, CopiesShareTheBytes) {
  const SourceFile source = SourceFile::fromText("t.nc", "G1 X2");
  const SourceFile copy = source;
  EXPECT_EQ(copy.text().data(), source.text().data());
  EXPECT_EQ(copy.text({3, 5}), "X2");
}

TEST(SourceFile, ManyThreadsMayAskFirst) {
  const SourceFile source = SourceFile::fromText("t.nc", "(Ø)\nG1\nG2");
  std::vector<Position> found(8);
  {
    std::vector<std::jthread> threads;
    for (Position &slot : found)
      threads.emplace_back([&slot, source] { slot = source.position(6); });
  }
  EXPECT_EQ(found, std::vector<Position>(8, Position{2, 2}));
}

class SourceFileOnDisk : public testing::Test {
protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("feedhold_source_file_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string &name, const std::string &bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  std::filesystem::path folder_;
};

TEST_F(SourceFileOnDisk, IsRead) {
  const std::filesystem::path path = write("O1000.nc", "%\r\nO1000\0M30\r\n%"s);
  Result<SourceFile> source = SourceFile::open(path);
  ASSERT_TRUE(source.ok());
  EXPECT_EQ(source.value().text(), "%\r\nO1000\0M30\r\n%"s);
  EXPECT_EQ(source.value().path(), path.generic_string());
  EXPECT_EQ(source.value().lineCount(), 3U);
}

TEST_F(SourceFileOnDisk, MayBeEmpty) {
  const Result<SourceFile> source = SourceFile::open(write("empty.nc", ""));
  ASSERT_TRUE(source.ok());
  EXPECT_EQ(source.value().text(), "");
  EXPECT_EQ(source.value().lineCount(), 1U);
  EXPECT_EQ(source.value().position(0), (Position{1, 1}));
}

TEST_F(SourceFileOnDisk, RefusesWhatIsNoProgram) {
  EXPECT_NE(SourceFile::open(folder_).error().message.find("is a folder"), std::string::npos);
  EXPECT_NE(SourceFile::open(folder_ / "none.nc").error().message.find("cannot open"), std::string::npos);
  EXPECT_NE(SourceFile::open("/dev/null").error().message.find("not a regular file"), std::string::npos);
}

TEST_F(SourceFileOnDisk, RefusesAFileThatIsTooLarge) {
  const std::filesystem::path path = write("huge.nc", "");
  std::filesystem::resize_file(path, SourceFile::kLargestSize + 1); // sparse: takes no room on the disk
  EXPECT_NE(SourceFile::open(path).error().message.find("larger than 1024 MiB"), std::string::npos);
}

} // namespace
} // namespace feedhold
