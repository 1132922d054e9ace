// Parts: what is written is read again, what is damaged is not, and only parts of one whole run are joined.
#include "findings/session/part.h"

#include <gtest/gtest.h>

namespace feedhold {
namespace {

RunPart part(std::uint32_t index, std::uint32_t count) {
  return {.tool = "feedhold 1",
          .prover = "",
          .command = {"check", "--isolated", "nc"},
          .shard = {index, count},
          .costs = {{"a b.nc", 12}},
          .answers = {{"key " + std::to_string(index), std::string("a\n\0b", 4)}}};
}

TEST(RunPart, IsReadAsItWasWritten) {
  const Result<RunPart> read = readPart(writePart(part(2, 3)));
  ASSERT_TRUE(read);
  EXPECT_EQ(read.value().command, part(2, 3).command);
  EXPECT_EQ(read.value().shard, (Shard{2, 3}));
  EXPECT_EQ(read.value().costs, part(2, 3).costs);
  EXPECT_EQ(read.value().answers, part(2, 3).answers);
  EXPECT_EQ(writePart(read.value()), writePart(part(2, 3)));
}

TEST(RunPart, NoDamageIsRead) {
  const std::string whole = writePart(part(1, 1));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    EXPECT_FALSE(readPart(damaged)) << i;
    EXPECT_FALSE(readPart(whole.substr(0, i))) << i;
  }
}

TEST(RunPart, AllPartsOfOneRunAreJoined) {
  const Result<RunPart> joined = joinParts({part(2, 2), part(1, 2), part(2, 2)});
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined.value().answers.size(), 2U);
}

TEST(RunPart, WhatIsMissingIsNamed) {
  const Result<RunPart> joined = joinParts({part(2, 4)});
  ASSERT_FALSE(joined);
  EXPECT_EQ(joined.error().message, "of 4 parts, 1, 3, 4 are missing");
}

TEST(RunPart, OtherRunsAndBuildsAreRefused) {
  RunPart other = part(1, 2);
  other.command.push_back("other");
  EXPECT_FALSE(joinParts({other, part(2, 2)}));
  other = part(1, 2);
  other.tool = "feedhold 2";
  EXPECT_FALSE(joinParts({other, part(2, 2)}));
  EXPECT_FALSE(joinParts({part(1, 3), part(2, 2)}));
  EXPECT_FALSE(joinParts({}));
}

} // namespace
} // namespace feedhold
