// A line that says what it is, the hash of the rest, the record.
#include "findings/session/part.h"

#include "base/support/record.h"
#include "base/support/sha256.h"

#include <fmt/format.h>

#include <set>

namespace feedhold {

namespace {

constexpr std::string_view kPartFormat = "feedhold part 1";

std::string partHead(std::string_view record) { return fmt::format("{}\n{}\n", kPartFormat, sha256(record)); }

std::string missingOf(const std::set<std::uint32_t> &found, std::uint32_t count) {
  constexpr std::size_t kMostNamed = 10;
  std::vector<std::uint32_t> missing;
  for (std::uint32_t index = 1; index <= count && missing.size() <= kMostNamed; ++index)
    if (!found.contains(index))
      missing.push_back(index);
  if (missing.size() <= kMostNamed)
    return fmt::format("{}", fmt::join(missing, ", "));
  missing.pop_back();
  return fmt::format("{} and more", fmt::join(missing, ", "));
}

} // namespace

std::string writePart(const RunPart &part) {
  const auto &[tool, prover, command, shard, costs, answers] = part;
  RecordWriter writer;
  writer.text(tool);
  writer.text(prover);
  writer.list(command, [&](const std::string &word) { writer.text(word); });
  writer.number(shard.index);
  writer.number(shard.count);
  writer.list(costs, [&](const auto &row) {
    writer.text(row.first);
    writer.number(row.second);
  });
  writer.list(answers, [&](const auto &row) {
    writer.text(row.first);
    writer.text(row.second);
  });
  const std::string record = writer.finish();
  return partHead(record) + record;
}

Result<RunPart> readPart(std::string_view bytes) {
  const std::size_t head = partHead("").size();
  if (!bytes.starts_with(kPartFormat))
    return Error{"not a part that this build of feedhold has written"};
  if (bytes.size() < head || bytes.substr(0, head) != partHead(bytes.substr(head)))
    return Error{"the part is damaged; run its shard again"};
  RecordReader reader(bytes.substr(head));
  RunPart part;
  part.tool = reader.text();
  part.prover = reader.text();
  reader.list([&] { part.command.emplace_back(reader.text()); });
  part.shard.index = static_cast<std::uint32_t>(reader.numberUpTo(kMostShards));
  part.shard.count = static_cast<std::uint32_t>(reader.numberUpTo(kMostShards));
  reader.list([&] {
    const std::string_view file = reader.text();
    part.costs.emplace(file, reader.number());
  });
  reader.list([&] {
    const std::string_view key = reader.text();
    part.answers.emplace(key, reader.text());
  });
  if (!reader.isDone() || !isShard(part.shard))
    return Error{"the part is damaged; run its shard again"};
  return part;
}

Result<RunPart> joinParts(std::vector<RunPart> parts) {
  if (parts.empty())
    return Error{"there are no parts"};
  std::set<std::uint32_t> found;
  RunPart joined{
      parts.front().tool, parts.front().prover, parts.front().command, {1, parts.front().shard.count}, {}, {}};
  for (RunPart &part : parts) {
    if (part.tool != joined.tool)
      return Error{"the parts were made by different builds of feedhold"};
    if (part.prover != joined.prover)
      return Error{fmt::format("the parts were proved with different solvers: {}, and {}", joined.prover, part.prover)};
    if (part.command != joined.command)
      return Error{fmt::format("the parts are of different runs: `{}` and `{}`", fmt::join(joined.command, " "),
                               fmt::join(part.command, " "))};
    if (part.shard.count != joined.shard.count)
      return Error{fmt::format("one part is one of {}, another is one of {}", joined.shard.count, part.shard.count)};
    found.insert(part.shard.index);
    joined.costs.merge(part.costs);
    joined.answers.merge(part.answers);
  }
  if (found.size() < joined.shard.count)
    return Error{fmt::format("of {} parts, {} {} missing", joined.shard.count, missingOf(found, joined.shard.count),
                             joined.shard.count - found.size() == 1 ? "is" : "are")};
  return joined;
}

} // namespace feedhold
