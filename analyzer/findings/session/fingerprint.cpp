// Hashes what a finding is about.
#include "findings/session/fingerprint.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

// A block longer than this is not a line that a person edits; hashing it for each of its findings would be quadratic.
constexpr std::uint32_t kLongestBlock = 2048;

std::string hexadecimal(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

} // namespace

std::string Fingerprints::of(const RuleInfo &rule, Span place) {
  const BlockId block = context_.tree.blockAt(place.begin);
  const std::string subject = fmt::format("{}\n{}\n{}", rule.name, programName(block), blockText(block, place));
  const std::uint64_t hash = stableHash(subject);
  const std::uint32_t before = seen_[hash]++;
  return hexadecimal(stableHash(fmt::format("\n{}", before), hash));
}

std::string Fingerprints::programName(BlockId block) const {
  if (context_.model.programs.empty())
    return {};
  return toString(context_.model.programs[context_.model.programOf(block)].name);
}

std::string Fingerprints::blockText(BlockId id, Span place) const {
  const Block &block = context_.tree.blocks[id];
  Span span = block.span();
  Span number{span.begin, span.begin};
  if (span.size() > kLongestBlock)
    span = {place.begin, std::min(place.end, place.begin + kLongestBlock)};
  else if (const Word *word = findWord(context_.tree, id, 'N'); word != nullptr && !block.has(Block::kData))
    number = word->span();
  std::string text;
  for (std::uint32_t at = span.begin; at < span.end; ++at) {
    const char c = context_.source.text()[at];
    if (!isBlank(c) && (at < number.begin || at >= number.end))
      text.push_back(toUpper(c));
  }
  return text;
}

std::string LineFingerprints::of(const RuleInfo &rule, Span place) {
  const Span line = source_.lineSpan(source_.lineOf(place.begin));
  const std::uint64_t hash =
      stableHash(fmt::format("{}\n{}", rule.name, toUpper(trimmed(source_.text(line).substr(0, kLongestBlock)))));
  return hexadecimal(stableHash(fmt::format("\n{}", seen_[hash]++), hash));
}

std::string fingerprintOfFile(const RuleInfo &rule, std::string_view fileName) {
  return hexadecimal(stableHash(fmt::format("{}\n{}", rule.name, fileName)));
}

} // namespace feedhold
