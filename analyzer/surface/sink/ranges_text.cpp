// Ranges for people: the program with what is known before each block, a fact a line.
#include "base/support/text.h"
#include "surface/sink/ranges_facts.h"
#include "surface/sink/ranges_sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace feedhold {

namespace {

using Lines = std::vector<std::pair<std::string, std::string>>; // a name, and what is known

Lines linesOf(const StateFacts &facts) {
  Lines lines;
  for (const auto *values : {&facts.variables, &facts.positions})
    for (const ValueFact &fact : *values)
      lines.emplace_back(fact.name, textOf(fact));
  for (const ModeFact &fact : facts.modes)
    lines.emplace_back(fact.name, textOf(fact));
  for (const ValueFact &fact : facts.settings)
    lines.emplace_back(fact.name, textOf(fact));
  std::string calls;
  for (const std::string &call : facts.modalCalls)
    calls += (calls.empty() ? "" : ", ") + call;
  if (facts.maybeOtherModalCalls)
    calls += calls.empty() ? "one may be active" : ", or another";
  if (!calls.empty())
    lines.emplace_back("modal call", calls);
  return lines;
}

/// The lines that are new or say something else, and those of which nothing is known any more.
Lines changesFrom(const Lines &before, const Lines &now) {
  Lines changes;
  for (const auto &line : now)
    if (std::find(before.begin(), before.end(), line) == before.end())
      changes.push_back(line);
  for (const auto &[name, text] : before)
    if (std::none_of(now.begin(), now.end(), [&](const auto &line) { return line.first == name; }))
      changes.emplace_back(name, "not known");
  return changes;
}

class RangesText {
public:
  explicit RangesText(const RangesReport &report) : report_(report), states_(report.states) {}

  std::string write() {
    if (states_.gaveUp)
      return fmt::format("nothing is told: {}\n", *states_.gaveUp);
    for (const ContextStates &context : states_.contexts)
      if (!context.blocks.empty())
        writeContext(context);
    if (text_.empty())
      text_ = report_.line ? fmt::format("no run comes to line {}\n", *report_.line) : "no run comes to a block\n";
    if (states_.isCutShort)
      text_ += "\nthere are too many blocks to show all; FILE:LINE shows what is known before one\n";
    std::set<std::string> notes;
    for (const NotFollowedNote &note : states_.notFollowed)
      notes.insert(fmt::format("not followed: {}, {}\n", note.reason, where(note.place)));
    if (!notes.empty())
      text_ += '\n';
    for (const std::string &note : notes)
      text_ += note;
    return std::move(text_);
  }

private:
  void writeContext(const ContextStates &context) {
    const ProgramFile &file = report_.programs.file(context.file);
    const ModalTable modes(*file.dialect);
    if (!text_.empty())
      text_ += '\n';
    text_ += heading(context);
    Lines before;
    for (BlockId block = firstBlock(context); block < lastBlock(context); block = block.next()) {
      const auto state = context.blocks.find(block);
      if (state == context.blocks.end()) {
        if (isMissed(context, block))
          writeBlock(file, block, "   (no run comes here)");
        continue;
      }
      writeBlock(file, block, "");
      Lines now = linesOf(factsOf(state->second, context, report_.programs, modes));
      writeFacts(report_.line ? now : changesFrom(before, now));
      before = std::move(now);
    }
  }
  BlockId firstBlock(const ContextStates &context) const {
    return report_.line ? context.blocks.begin()->first
                        : report_.programs.file(context.file).model->programs[context.program].first;
  }
  BlockId lastBlock(const ContextStates &context) const {
    return report_.line ? context.blocks.rbegin()->first.next()
                        : report_.programs.file(context.file).model->programs[context.program].last;
  }
  /// Something stands there that the control executes; by M97 a program calls only a part of itself.
  bool isMissed(const ContextStates &context, BlockId block) const {
    const ProgramFile &file = report_.programs.file(context.file);
    const NodeId node = file.cfg.nodeOf(block);
    return context.calls.empty() && !states_.isCutShort && node.index() < file.cfg.nodes.size() &&
           file.cfg.nodes[node].block == block && file.model->programOf(block) == context.program;
  }
  std::string heading(const ContextStates &context) const {
    const ProgramFile &file = report_.programs.file(context.file);
    const std::string name = programName(file, context.program);
    if (context.calls.empty())
      return context.program == context.start.program && context.file == context.start.file
                 ? fmt::format("{}, whatever was before\n", name)
                 : fmt::format("{}, entered in a way that is not followed\n", name);
    std::string calls;
    for (std::size_t i = context.calls.size(); i-- > 0;)
      calls += fmt::format("{} {}", calls.empty() ? ", called from" : ", from", programAndLine(context.calls[i]));
    return name + calls + "\n";
  }
  void writeBlock(const ProgramFile &file, BlockId block, std::string_view remark) {
    const std::uint32_t line = file.source->lineOf(file.tree->blocks[block].begin);
    const std::string code(trimmed(file.source->utf8(file.source->lineSpan(line))));
    text_ += fmt::format("{:>4}  {}{}\n", line, code, remark);
  }
  void writeFacts(const Lines &lines) {
    std::size_t width = 0;
    for (const auto &line : lines)
      width = std::max(width, line.first.size());
    for (const auto &[name, text] : lines)
      text_ += fmt::format("          {:<{}}  {}\n", name, width, text);
  }

  // ---- places ----

  static std::string programName(const ProgramFile &file, ProgramId program) {
    const std::string name = toString(file.model->programs[program].name);
    return name.empty() ? "the program" : name;
  }
  std::uint32_t lineAt(Place place) const {
    const ProgramFile &file = report_.programs.file(place.file);
    return file.source->lineOf(file.tree->blocks[file.cfg.nodes[place.node].block].begin);
  }
  std::string programAndLine(Place place) const {
    const ProgramFile &file = report_.programs.file(place.file);
    return fmt::format("{} line {}", programName(file, file.model->programOf(file.cfg.nodes[place.node].block)),
                       lineAt(place));
  }
  std::string where(Place place) const {
    return report_.programs.size() > 1 ? fmt::format("line {} of {}", lineAt(place), report_.shown[place.file.index()])
                                       : fmt::format("line {}", lineAt(place));
  }

  const RangesReport &report_;
  const BlockStates &states_;
  std::string text_;
};

} // namespace

std::string writeRangesText(const RangesReport &report) { return RangesText(report).write(); }

} // namespace feedhold
