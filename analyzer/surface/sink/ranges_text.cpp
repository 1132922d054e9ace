// Ranges for people: the program with what is known before each block, a fact a line.
#include "base/support/text.h"
#include "surface/sink/ranges_facts.h"
#include "surface/sink/ranges_sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace feedhold {

namespace {

struct Line {
  std::string name;
  std::string text;
  std::string_view otherwise; // what holds if there is no such line
  bool isGrouped = false;     // another line stands for it
  friend bool operator==(const Line &, const Line &) = default;
};
using Lines = std::vector<Line>;

constexpr std::string_view kAsAtStart = "as at start";
constexpr std::string_view kNotKnown = "not known";
constexpr std::string_view kNone = "none";
constexpr std::string_view kOtherVariables = "other variables";
constexpr std::size_t kFew = 4; // unknown things that are named one by one

/// Many unknown things get one line.
void addTogether(Lines &lines, Lines some, std::string name, std::string_view unknown) {
  const auto isUnknownLine = [&](const Line &line) { return line.text == unknown; };
  const bool isMany = std::count_if(some.begin(), some.end(), isUnknownLine) > static_cast<std::ptrdiff_t>(kFew);
  const std::string_view otherwise = some.empty() ? kNone : some.front().otherwise;
  for (Line &line : some) {
    line.isGrouped = isMany && isUnknownLine(line);
    lines.push_back(std::move(line));
  }
  if (isMany)
    lines.push_back({std::move(name), std::string(unknown), otherwise});
}

std::string_view otherwiseOf(const ValueFact &setting) {
  const bool isOffset = setting.name.starts_with("G") || setting.name == "length offset";
  return isOffset || setting.name.starts_with("cycle") ? kNotKnown : kNone;
}

Lines linesOf(const StateFacts &facts) {
  Lines lines;
  for (const ValueFact &fact : facts.variables)
    lines.push_back({fact.name, textOf(fact), kAsAtStart});
  if (facts.othersAreUnknown)
    lines.push_back({std::string(kOtherVariables), std::string(kNotKnown), kAsAtStart});
  Lines axes;
  for (const ValueFact &fact : facts.positions)
    axes.push_back({fact.name, textOf(fact), kAsAtStart});
  addTogether(lines, std::move(axes), "other axes", kNotKnown);
  Lines modes;
  for (const ModeFact &fact : facts.modes)
    modes.push_back({fact.name, textOf(fact), kAsAtStart});
  addTogether(lines, std::move(modes), "other modes", "any code");
  Lines words;
  Lines settings;
  for (const ValueFact &fact : facts.settings)
    if (fact.name.size() == 1)
      words.push_back({fact.name, textOf(fact), kAsAtStart});
    else
      settings.push_back({fact.name, textOf(fact), otherwiseOf(fact)});
  addTogether(lines, std::move(words), "other words", kNotKnown);
  addTogether(lines, std::move(settings), "scaling, mirror, rotation", kNotKnown);
  std::string calls;
  for (const std::string &call : facts.modalCalls)
    calls += (calls.empty() ? "" : ", ") + call;
  if (facts.maybeOtherModalCalls)
    calls += calls.empty() ? "one may be active" : ", or another";
  if (!calls.empty())
    lines.push_back({"modal call", calls, kNone});
  return lines;
}

/// The lines that are new or say something else, and what has become of those that are gone.
Lines changesFrom(const Lines &before, const Lines &now) {
  std::unordered_multimap<std::string_view, const Line *> linesBefore; // a program may have hundreds of variables
  for (const Line &line : before)
    linesBefore.emplace(line.name, &line);
  std::unordered_set<std::string_view> namesNow;
  for (const Line &line : now)
    namesNow.insert(line.name);
  Lines changes;
  for (const Line &line : now) {
    const auto [first, last] = linesBefore.equal_range(line.name);
    if (std::none_of(first, last, [&](const auto &entry) { return *entry.second == line; }) &&
        (!line.isGrouped || first != last))
      changes.push_back({line.name, line.text, line.otherwise});
  }
  const bool variablesAreUnknown = namesNow.contains(kOtherVariables);
  const auto ofCycle = [](const Line &line) { return line.name.starts_with("cycle"); };
  const bool cycleEnded = std::none_of(now.begin(), now.end(), ofCycle); // the mode says so
  for (const Line &line : before)
    if (!namesNow.contains(line.name) && !line.isGrouped && !(cycleEnded && ofCycle(line))) {
      const bool isUnknownVariable = line.name.starts_with('#') && variablesAreUnknown;
      changes.push_back({line.name, std::string(isUnknownVariable ? kNotKnown : line.otherwise), {}});
    }
  return changes;
}

class RangesText {
public:
  explicit RangesText(const RangesReport &report) : report_(report), states_(report.states) {}

  std::string write() {
    if (states_.gaveUp)
      return fmt::format("no ranges: {}\n", *states_.gaveUp);
    for (const ContextStates &context : states_.contexts)
      if (!context.blocks.empty())
        writeContext(context);
    if (text_.empty())
      text_ = report_.line ? fmt::format("no run reaches line {}\n", *report_.line) : "no run reaches any block\n";
    if (states_.isCutShort)
      text_ += "\ntoo many blocks to show all; FILE:LINE shows a single one\n";
    std::set<std::string> notes;
    for (const UnmodelledNote &note : states_.unmodelled)
      notes.insert(fmt::format("not modelled: {}, {}\n", note.reason, where(note.place)));
    if (!notes.empty())
      text_ += '\n';
    for (const std::string &note : notes)
      text_ += note;
    return std::move(text_);
  }

private:
  void writeContext(const ContextStates &context) {
    const ProgramFile &file = report_.programs.file(context.file);
    const FactsOfStates facts(context, report_.programs);
    if (!text_.empty())
      text_ += '\n';
    text_ += heading(context);
    Lines before;
    for (BlockId block = firstBlock(context); block < lastBlock(context); block = block.next()) {
      const auto state = context.blocks.find(block);
      if (state == context.blocks.end()) {
        if (isMissed(context, block))
          writeBlock(file, block, "   (unreachable)");
        continue;
      }
      writeBlock(file, block, "");
      Lines now = linesOf(facts.at(state->second.state()));
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
                 ? fmt::format("{}, {}\n", name,
                               context.assumesContract ? "for the calls that its contract allows"
                                                       : "for any start state")
                 : fmt::format("{}, entered by a call that is not modelled\n", name);
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
    for (const Line &line : lines)
      width = std::max(width, line.isGrouped ? 0 : line.name.size());
    for (const Line &line : lines)
      if (!line.isGrouped)
        text_ += fmt::format("          {:<{}}  {}\n", line.name, width, line.text);
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
