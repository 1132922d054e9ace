// coolant-not-started: a cut between `M06` and `M09` without the `M08` that other tools have.
#include "rules/motion/tool_sections.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::rules::coolant_not_started {
namespace {

constexpr std::array kCutting = {CodeAction::Linear,         CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise,
                                 CodeAction::CycleDrill,     CodeAction::CycleDwell,   CodeAction::CyclePeck,
                                 CodeAction::CycleChipBreak, CodeAction::CycleBore,    CodeAction::CycleBoreStop,
                                 CodeAction::CycleBoreDwell, CodeAction::CycleFineBore};
constexpr std::array kBesideCoolant = {CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise,
                                       CodeAction::SpindleStop, CodeAction::ToolChange};
/// In comments: the tool is meant to cut without.
constexpr std::array<std::string_view, 5> kDryWords = {"DRY", "AIR", "COOL", "TROCKEN", "LUFT"};

template <typename Actions> bool isOneOf(const Code *code, const Actions &actions) {
  return code && std::ranges::find(actions, code->action) != actions.end();
}

/// Coolant in one section.
struct Tool {
  const ToolSection *section;
  const Word *on = nullptr;
  const Word *cut = nullptr;
  const Word *off = nullptr; // behind the cut
  bool startsOff = true;     // M09 came last, or nothing did
  bool mayBeSwitchedUnseen = false;
};

class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), hidden_(program, context) {}

  /// `isOn`: where the section begins; then where it ends.
  Tool read(const ToolSection &section, bool &isOn) const {
    Tool tool{.section = &section};
    for (BlockId block = section.first; block < section.last; block = block.next()) {
      tool.mayBeSwitchedUnseen = tool.mayBeSwitchedUnseen || hidden_.isIn(block) || speaksOfDryCut(block);
      for (const Word &word : context_.tree.wordsOf(block))
        if (word.isCode())
          readCode(word, tool, isOn);
    }
    return tool;
  }

private:
  void readCode(const Word &word, Tool &tool, bool &isOn) const {
    const Code *code = codeOf(word, context_.dialect);
    if (code && code->action == CodeAction::CoolantOn) {
      tool.on = tool.on ? tool.on : &word;
      isOn = true;
    } else if (code && code->action == CodeAction::CoolantOff) {
      tool.off = tool.cut ? &word : nullptr;
      isOn = false;
    } else if (isOneOf(code, kCutting)) {
      tool.startsOff = tool.cut ? tool.startsOff : !isOn;
      tool.cut = tool.cut ? tool.cut : &word;
      tool.off = nullptr;
    } else if (maySwitch(word, code)) {
      tool.mayBeSwitchedUnseen = true;
    }
  }
  /// M codes of the machine builder: air, coolant through the spindle.  A probe cuts nothing.
  static bool maySwitch(const Word &word, const Code *code) {
    if (!code || code->action == CodeAction::Anything || isSkip(code->role))
      return true;
    return word.address() == 'M' && !isOneOf(code, kBesideCoolant) && code->role != CodeRole::ProgramEnd &&
           code->role != CodeRole::Return && code->role != CodeRole::ProgramStop;
  }
  bool speaksOfDryCut(BlockId block) const {
    return std::ranges::any_of(context_.tree.commentsOf(block), [&](const Comment &comment) {
      const std::string text = toUpper(context_.text(comment.span));
      return std::ranges::any_of(kDryWords,
                                 [&](std::string_view word) { return text.find(word) != std::string::npos; });
    });
  }

  const FileContext &context_;
  HiddenWork hidden_;
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  constexpr std::size_t kHabit = 2;
  const std::vector<ToolSection> sections = toolSectionsOf(program, context);
  if (context.dialect.machine != MachineKind::Milling || sections.size() <= kHabit)
    return;
  const Reader reader(program, context);
  std::vector<Tool> with, without;
  bool isOn = false;
  const ToolSection head{sections.front().change, context.model.programs[program].first, sections.front().first};
  bool isSwitchedUnseen = reader.read(head, isOn).mayBeSwitchedUnseen;
  for (const ToolSection &section : sections) {
    Tool tool = reader.read(section, isOn);
    const bool isHere = tool.mayBeSwitchedUnseen;
    tool.mayBeSwitchedUnseen = isHere || isSwitchedUnseen;
    isSwitchedUnseen = isHere || (isSwitchedUnseen && !tool.on && !tool.off);
    if (tool.cut && (tool.on || tool.off))
      (tool.on ? with : without).push_back(tool);
  }
  // A second tool without: M09 belongs to the end of every tool here, whether it cuts dry or not.
  if (with.size() < kHabit || without.size() != 1)
    return;
  const Tool &dry = without.front();
  if (dry.mayBeSwitchedUnseen || !dry.startsOff)
    return;
  reporter.report({.message = fmt::format("no coolant is switched on between {} and this cut",
                                          context.quoted(dry.section->change->span())),
                   .span = dry.cut->span(),
                   .labels = {{dry.off->span(), "switched off behind it"},
                              {with.front().on->span(), "switched on for another tool"}},
                   .notes = {"the tool cuts dry: it may wear out or break",
                             "switch the coolant on before this cut, or take the code behind it out"}});
}

} // namespace

extern const Rule coolantNotStarted;
const Rule coolantNotStarted{
    .info = {"coolant-not-started", Category::Motion, Severity::Warning,
             "Reports a tool that cuts with the coolant off before an `M09`, when the other tools that have `M09` "
             "switch it on."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::coolant_not_started
