// Whether a program may be released.  An alarm that a call can raise is not a fault by itself, but the contract has to
// declare it.
#include "base/support/text.h"
#include "surface/report/report_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::certificate {

namespace {

using prove::Obligation;
using prove::ObligationKind;
using prove::Verdict;

constexpr std::size_t kMostAlarmsNamed = 6;

/// `#3000=120`.  Nothing where the number is computed: it may be any.
std::optional<std::uint32_t> writtenNumber(const ProjectFile &file, const Dialect &dialect, const Assign &assign) {
  const auto *assignment = std::get_if<Assignment>(&file.tree.statements[assign.first].node);
  const auto variable = assignment ? variableNumber(file.tree, assignment->target) : std::nullopt;
  if (assign.count != 1 || !variable || !raisesAlarm(dialect, *variable))
    return std::nullopt;
  const auto value = literalValue(file.tree, assignment->value);
  const auto number = value ? value->asInteger() : std::nullopt;
  return number && *number >= 0 && *number <= 99'999 ? std::optional(static_cast<std::uint32_t>(*number))
                                                     : std::nullopt;
}

/// What the operator reads: `#3000=120(NO FEATURE)`.
std::string messageBehind(const ProjectFile &file, const Node &node, Span assignment) {
  for (const Comment &comment : file.tree.commentsOf(node.block))
    if (comment.span.begin >= assignment.begin) {
      std::string text = file.source.utf8(comment.span);
      std::erase_if(text, [](char c) { return c == '(' || c == ')'; });
      return std::string(trimmed(text));
    }
  return {};
}

} // namespace

std::optional<RaisedAlarm> raisedAlarm(const Obligation &obligation, const ProvedFile &file) {
  if (obligation.kind != ObligationKind::AlarmUnreachable || obligation.verdict != Verdict::Refuted)
    return std::nullopt;
  RaisedAlarm alarm;
  const Node &node = file.project->set->file(FileId(0)).cfg.nodes[obligation.place.node];
  if (const auto *assign = std::get_if<Assign>(&node.instruction)) {
    alarm.number = writtenNumber(file.file(), file.project->dialect(), *assign);
    alarm.message = messageBehind(file.file(), node, file.file().tree.statements[assign->first].span);
  }
  return alarm;
}

namespace {

/// Lines from 1.  How the control reads such a block is unknown: most stop there.
std::vector<std::size_t> unreadableLines(const ProjectFile &file, ProgramId program) {
  std::vector<std::size_t> lines;
  for (BlockId block(0); block.index() < file.tree.blocks.size(); block = BlockId(block.index() + 1))
    if ((file.tree.blocks[block].flags & (Block::kBroken | Block::kCommentTail)) != 0 &&
        file.model.programOf(block) == program)
      lines.push_back(file.source.lineOf(file.tree.blocks[block].span().begin));
  return lines;
}

std::string claims(std::size_t count) { return fmt::format("{} claim{}", count, count == 1 ? "" : "s"); }

struct Summary {
  VerdictCounts counts;
  std::size_t raised = 0;  // alarms that no clause declares
  std::string alarms = {}; // these: `alarms 7, 8`
  bool isGouge = false;
};
Summary summaryOf(const ProvedFile &file, const ProvedProgram &program) {
  Summary summary;
  summary.counts.add(program.proof);
  for (const Obligation &obligation : program.proof.obligations) {
    summary.isGouge = summary.isGouge || (obligation.verdict.witness() && obligation.verdict.witness()->gouge);
    const auto alarm = raisedAlarm(obligation, file);
    if (alarm && ++summary.raised <= kMostAlarmsNamed)
      summary.alarms += (summary.alarms.empty() ? "" : ", ") +
                        (alarm->number ? std::to_string(*alarm->number) : std::string("of a computed number"));
  }
  summary.alarms = (summary.raised == 1 ? "alarm " : "alarms ") + summary.alarms;
  if (summary.raised > kMostAlarmsNamed)
    summary.alarms += fmt::format(" and {} more", summary.raised - kMostAlarmsNamed);
  return summary;
}

} // namespace

std::string sentenceOf(const ProvedFile &file, const ProvedProgram &program) {
  const Summary summary = summaryOf(file, program);
  const VerdictCounts &counts = summary.counts;
  if (counts.all() == 0)
    return "Nothing is claimed of this program, so nothing is proved.";
  const std::size_t broken = counts.of(Verdict::Refuted) - summary.raised;
  const std::size_t unknown = counts.of(Verdict::Unknown);
  std::string words;
  if (broken != 0)
    words = fmt::format("{} {} of {} {}.",
                        summary.isGouge ? "Do not run: the tool can go where it must not." : "Do not release:", broken,
                        claims(counts.all()), broken == 1 ? "fails" : "fail");
  if (summary.raised != 0)
    words += fmt::format("{}{} can be raised, and no `@ALARM` states when.",
                         words.empty() ? "Decide first: " : " Also, ", summary.alarms);
  if (unknown != 0)
    words += fmt::format("{}{} could be neither proved nor refuted.", words.empty() ? "Do not release yet: " : " ",
                         claims(unknown));
  if (const std::vector<std::size_t> lines = unreadableLines(file.file(), program.program); !lines.empty())
    words += fmt::format("{}{} that cannot be read.", words.empty() ? "Do not release yet: " : " Also, ",
                         lines.size() == 1
                             ? fmt::format("line {} has text", lines.front())
                             : fmt::format("{} lines have text, the first is line {},", lines.size(), lines.front()));
  if (!words.empty())
    return words;
  const std::string_view calls = file.file().contracts.of(program.program) != nullptr
                                     ? "for every call that its contract allows"
                                     : "for every input";
  return counts.all() == 1 ? fmt::format("Its one claim holds {}.", calls)
                           : fmt::format("All {} hold {}.", claims(counts.all()), calls);
}

} // namespace feedhold::certificate

namespace feedhold {

std::string_view nameOf(ReleaseStatus status) {
  switch (status) {
  case ReleaseStatus::Ready: return "ready";
  case ReleaseStatus::Open: return "open";
  case ReleaseStatus::Alarms: return "alarms";
  case ReleaseStatus::Broken: return "refuted";
  }
  return "";
}

ReleaseStatus releaseStatusOf(const ProvedFile &file, const ProvedProgram &program) {
  const bool isRead = certificate::unreadableLines(file.file(), program.program).empty();
  ReleaseStatus status = isRead ? ReleaseStatus::Ready : ReleaseStatus::Open;
  for (const prove::Obligation &obligation : program.proof.obligations) {
    if (holds(obligation.verdict))
      continue;
    status = std::max(status, obligation.verdict == prove::Verdict::Unknown ? ReleaseStatus::Open
                              : certificate::raisedAlarm(obligation, file)  ? ReleaseStatus::Alarms
                                                                            : ReleaseStatus::Broken);
  }
  return status;
}

ReleaseStatus releaseStatusOf(const ProofsResult &proofs) {
  ReleaseStatus worst = ReleaseStatus::Ready;
  bool isAnythingClaimed = false;
  for (const ProvedFile &file : proofs.files)
    for (const ProvedProgram &program : file.programs) {
      worst = std::max(worst, releaseStatusOf(file, program));
      isAnythingClaimed = isAnythingClaimed || !program.proof.obligations.empty();
    }
  return isAnythingClaimed ? worst : std::max(worst, ReleaseStatus::Open);
}

} // namespace feedhold
