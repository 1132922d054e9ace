// Fingerprint: a name for a finding that outlives edits elsewhere in the file.
#pragma once

#include "findings/rule/rule.h"

#include <string>
#include <unordered_map>

namespace feedhold {

/// Made of the rule, the program's name, the text of the block without blanks and without its N number, and the number
/// of equal findings before it.  No line number and no path: moving a program does not change its findings.
/// Ask in the order of the findings of one file.
class Fingerprints {
public:
  explicit Fingerprints(const FileContext &context) : context_(context) {}
  /// 16 hexadecimal digits.
  std::string of(const RuleInfo &rule, Span place);

private:
  std::string programName(BlockId block) const;
  std::string blockText(BlockId block, Span place) const;

  const FileContext &context_;
  std::unordered_map<std::uint64_t, std::uint32_t> seen_;
};

/// The same for the lines of a file with contracts.
class LineFingerprints {
public:
  explicit LineFingerprints(const SourceFile &source) : source_(source) {}
  std::string of(const RuleInfo &rule, Span place);

private:
  const SourceFile &source_;
  std::unordered_map<std::uint64_t, std::uint32_t> seen_;
};

/// For a file without tree: a foreign language.
std::string fingerprintOfFile(const RuleInfo &rule, std::string_view fileName);

} // namespace feedhold
