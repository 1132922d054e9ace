// See the header.
#include "findings/draft/promises.h"

#include "base/support/text.h"
#include "meaning/cfg/reached_programs.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::draft {

namespace {

constexpr std::size_t kMostComputed = 12;
constexpr std::size_t kMostRanges = 12;

DraftClause promise(std::string text, std::string reason) {
  return {std::move(text), std::move(reason), Ground::Promise};
}

class PromiseMaker {
public:
  explicit PromiseMaker(const FlowFacts &facts)
      : facts_(facts), program_(facts.file.model->programs[facts.program]), entry_(facts) {}

  std::vector<DraftClauses> make() {
    const bool returns = comesBack(facts_);
    if (returns) {
      modal();
      positions();
      computed();
    }
    if (returns || facts_.programs.callGraph().isCalled({facts_.file.file, facts_.program}))
      assigns(); // of what the operator starts nobody asks it
    return std::move(groups_);
  }

private:
  std::uint32_t lineOf(BlockId block) const {
    return facts_.file.source->lineOf(facts_.file.tree->blocks[block].begin);
  }

  void modal() {
    DraftClauses group = {promise("@ENSURE MODAL PRESERVED", "it leaves the modal state as it was")};
    for (const std::string_view words : {"F", "F S", "F S T D H"})
      group.push_back(promise(fmt::format("@ENSURE MODAL PRESERVED EXCEPT {}", words),
                              fmt::format("it leaves the modal state as it was, but for {}", words)));
    if (auto codes = codesOnReturn(); !codes.empty())
      group.push_back(promise(fmt::format("@ENSURE {}", fmt::join(codes, " ")), "active on every return"));
    groups_.push_back(std::move(group));
  }

  /// Of the groups that the program itself changes; a motion code is of no use to callers.
  std::vector<std::string> codesOnReturn() const {
    std::vector<std::string> codes;
    const ModalTable &modes = facts_.modes;
    for (const std::uint8_t group : groupsWritten()) {
      std::optional<std::uint8_t> only;
      bool isSame = group != modes.groupOf(ModalKind::Motion);
      for (const ExitFact &exit : facts_.exits()) {
        if (exit.end != PathEnd::Returns)
          continue;
        const auto code = exit.state.codes[group].only();
        isSame = isSame && code && only.value_or(*code) == *code;
        only = code;
      }
      if (isSame && only && *only < modes.group(group).codes.size())
        codes.push_back(textOf(*modes.group(group).codes[*only]));
    }
    return codes;
  }
  static std::string textOf(const Code &code) {
    return code.tenths % 10 == 0 ? fmt::format("G{:02}", code.tenths / 10)
                                 : fmt::format("G{}.{}", code.tenths / 10, code.tenths % 10);
  }
  std::set<std::uint8_t> groupsWritten() const {
    std::set<std::uint8_t> groups;
    for (BlockId block = program_.first; block < program_.last; block = block.next())
      for (const Word &word : facts_.file.tree->wordsOf(block))
        if (const auto tenths = word.tenths(); tenths && word.isCode() && word.address() == 'G')
          if (const Code *code = findGCode(*facts_.file.dialect, *tenths); code && facts_.modes.indexOf(*code))
            groups.insert(code->group);
    return groups;
  }

  /// `G04 X2.` moves nothing.
  bool isDwell(BlockId block) const {
    return std::ranges::any_of(facts_.file.tree->wordsOf(block), [&](const Word &word) {
      const auto tenths = word.isCode() && word.address() == 'G' ? word.tenths() : std::nullopt;
      const Code *code = tenths ? findGCode(*facts_.file.dialect, *tenths) : nullptr;
      return code && code->action == CodeAction::Dwell;
    });
  }

  void positions() {
    std::set<char> moved;
    for (BlockId block = program_.first; block < program_.last; block = block.next())
      for (const Word &word : isDwell(block) ? std::span<const Word>() : facts_.file.tree->wordsOf(block))
        if (std::string_view("XYZ").find(word.address()) != std::string_view::npos && !word.has(Word::kArgument))
          moved.insert(word.address());
    for (const char axis : moved)
      groups_.push_back({promise(fmt::format("@ENSURE POS[{}] EQ ENTRY[{}]", axis, axis),
                                 fmt::format("it comes back to where {} was", axis))});
  }

  bool isWritten(std::uint32_t variable) const {
    return std::ranges::any_of(facts_.file.model->variablesOf(facts_.program), [&](const VariableUse &use) {
      return use.write && use.number.value_or(variable) == variable;
    });
  }
  bool isKept(std::uint32_t variable) const {
    const VariableRange *row = findVariable(*facts_.file.dialect, variable);
    return row && (row->kind == VariableKind::Common || row->kind == VariableKind::Retentive);
  }

  /// `#140=#24-#5` where nothing else is ever assigned to it.
  void computed() {
    std::set<std::uint32_t> seen;
    for (const VariableUse &use : facts_.file.model->variablesOf(facts_.program)) {
      if (!use.write || !use.number || !isKept(*use.number) || !seen.insert(*use.number).second ||
          seen.size() > kMostComputed)
        continue;
      const Assignment *assignment = onlyAssignment(facts_, *use.number);
      const auto value = assignment ? entry_.textOverEntry(assignment->value) : std::nullopt;
      if (const auto text = value ? beforeTheCall(*value) : std::nullopt)
        groups_.push_back({promise(fmt::format("@ENSURE #{} EQ {}", *use.number, *text),
                                   fmt::format("line {} computes it", lineOf(use.block)))});
    }
  }
  /// With `OLD[..]` around variables that the program changes; absent: a clause cannot say it.
  std::optional<std::string> beforeTheCall(const std::string &value) const {
    std::string text;
    for (std::size_t at = 0; at < value.size();) {
      if (value[at] != '#') {
        text += value[at++];
        continue;
      }
      std::size_t end = at + 1;
      std::uint32_t number = 0;
      for (; end < value.size() && isDigit(value[end]); ++end)
        number = number * 10 + static_cast<std::uint32_t>(value[end] - '0');
      if (number != kVacantVariable && number > kLocalVariables && !isKept(number))
        return std::nullopt;
      const std::string name = value.substr(at, end - at);
      text += number != kVacantVariable && isWritten(number) ? fmt::format("OLD[{}]", name) : name;
      at = end;
    }
    return text;
  }

  void assigns() {
    const auto written = writtenForOthers();
    if (!written)
      return;
    std::vector<std::string> ranges;
    for (auto at = written->begin(); at != written->end();) {
      const std::uint32_t first = *at;
      std::uint32_t last = first;
      for (++at; at != written->end() && *at == last + 1; ++at)
        last = *at;
      ranges.push_back(first == last ? fmt::format("#{}", first) : fmt::format("#{}..#{}", first, last));
    }
    if (ranges.size() <= kMostRanges)
      groups_.push_back(
          {promise(fmt::format("@ASSIGNS {}", ranges.empty() ? "NOTHING" : fmt::format("{}", fmt::join(ranges, " "))),
                   "it changes no other common or system variable")});
  }
  /// By the program and by those that it calls; absent: that is not known.
  std::optional<std::set<std::uint32_t>> writtenForOthers() const {
    ReachedPrograms reached;
    collectReached(facts_.programs, {facts_.file.file, facts_.program}, reached);
    std::set<std::uint32_t> written;
    for (const ProgramRef &each : reached.programs) {
      const ProgramFile &file = facts_.programs.file(each.file);
      for (const VariableUse &use : file.model->variablesOf(each.program)) {
        if (!use.write)
          continue;
        if (!use.number)
          return std::nullopt;
        const VariableRange *row = findVariable(*file.dialect, *use.number);
        const bool isMessage = row && (row->role == VariableRole::Alarm || row->role == VariableRole::MessageStop);
        if (*use.number > kLocalVariables && !isMessage)
          written.insert(*use.number);
      }
    }
    return reached.orAny ? std::nullopt : std::optional(written);
  }

  const FlowFacts &facts_;
  const Program &program_;
  EntryValues entry_;
  std::vector<DraftClauses> groups_;
};

} // namespace

std::vector<DraftClauses> promiseGroups(const FlowFacts &facts) {
  return facts.isComplete() ? PromiseMaker(facts).make() : std::vector<DraftClauses>();
}

} // namespace feedhold::draft
