// spindle-not-restarted: `T2 M06`, `S3000`, and a cut; M03 stands only behind the first tool change.
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace feedhold::rules::spindle_not_restarted {
namespace {

constexpr std::array kDrilling = {CodeAction::CycleDrill,     CodeAction::CycleDwell,   CodeAction::CyclePeck,
                                  CodeAction::CycleChipBreak, CodeAction::CycleBore,    CodeAction::CycleBoreStop,
                                  CodeAction::CycleBoreDwell, CodeAction::CycleFineBore};
constexpr std::array kFeeding = {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise};
constexpr std::array kStarting = {CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise};
constexpr std::array kTapping = {CodeAction::CycleTap, CodeAction::CycleTapLeft}; // many controls start it then
constexpr std::array kHarmless = {CodeAction::CoolantOn, CodeAction::CoolantOff, CodeAction::SpindleStop};

/// What is programmed between two tool changes.
struct Section {
  const Word *change;
  const Word *start = nullptr;     // M03, M04
  const Word *speed = nullptr;     // S
  const Word *lateSpeed = nullptr; // S behind the last cut: of the next tool
  const Word *cut = nullptr;       // the first code that feeds the tool
  bool cutsForSure = false;        // a drilling cycle, coolant: no dowel pin, no stop for the bar
  bool mayStartUnseen = false;     // in a call, by an M code of the machine builder, by hand, on another path
};

template <typename Actions> bool isOneOf(const Code *code, const Actions &actions) {
  return code && std::ranges::find(actions, code->action) != actions.end();
}

class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), hidden_(program, context) {}

  /// `lateSpeed`: what the tool before has left for this one.
  Section read(const ToolSection &tool, const Word *lateSpeed) const {
    Section section{.change = tool.change, .speed = lateSpeed};
    for (BlockId block = tool.first; block < tool.last; block = block.next()) {
      section.mayStartUnseen = section.mayStartUnseen || hidden_.isIn(block);
      for (const Word &word : context_.tree.wordsOf(block))
        readWord(word, section);
    }
    return section;
  }

private:
  void readWord(const Word &word, Section &section) const {
    if (word.address() == 'S') {
      section.speed = section.speed ? section.speed : &word;
      section.lateSpeed = &word;
    }
    if (!word.isCode())
      return;
    const Code *code = codeOf(word, context_.dialect);
    if (isOneOf(code, kStarting))
      section.start = section.start ? section.start : &word;
    else if (isOneOf(code, kDrilling) || isOneOf(code, kFeeding))
      readCut(word, isOneOf(code, kDrilling), section);
    else if (code && code->action == CodeAction::CoolantOn)
      section.cutsForSure = true;
    if (mayStart(word, code) || isOneOf(code, kTapping))
      section.mayStartUnseen = true;
  }
  static void readCut(const Word &word, bool drills, Section &section) {
    section.cut = section.cut ? section.cut : &word;
    section.lateSpeed = nullptr;
    section.cutsForSure = section.cutsForSure || drills;
  }
  /// An M code that is not known not to; one of a cycle that taps, probes or skips.
  static bool mayStart(const Word &word, const Code *code) {
    if (!code || code->action == CodeAction::Anything || isSkip(code->role))
      return true;
    const bool isKnown = isOneOf(code, kStarting) || isOneOf(code, kHarmless) || code->role == CodeRole::ProgramEnd ||
                         code->action == CodeAction::ToolChange || code->role == CodeRole::Return;
    return word.address() == 'M' ? !isKnown && !isOptionalStop(word) : code->role == CodeRole::OwnWords;
  }
  static bool isOptionalStop(const Word &word) { return word.isNumber() && word.tenths() == 10; }

  const FileContext &context_;
  HiddenWork hidden_;
};

void tellStart(const Section &section, const Section &other, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("no `M03` or `M04` comes between {} and this cut",
                                          context.quoted(section.change->span())),
                   .span = section.cut->span(),
                   .labels = {{section.change->span(), "the spindle stops for the tool change"},
                              {other.start->span(), "started for another tool"}},
                   .notes = {"the tool is fed into the part with the spindle stopped",
                             "start the spindle with S and M03 before this cut"}});
}

void tellSpeed(const Section &section, const Section &other, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} starts the spindle with the speed of the tool before",
                                          context.quoted(section.start->span())),
                   .span = section.start->span(),
                   .labels = {{section.change->span(), "changed here"}, {other.speed->span(), "speed of another tool"}},
                   .notes = {"no S stands between the tool change and this code, as it does for the other tools",
                             "write the speed of this tool"}});
}

/// M03 with S before the first tool change, and no cut in between: it was meant for the tool that is changed in.
struct EarlyStart {
  const Word *start = nullptr;
  const Word *speed = nullptr;
};
EarlyStart startBefore(BlockId change, ProgramId program, const FileContext &context) {
  const HiddenWork hidden(program, context);
  EarlyStart early;
  for (BlockId block = context.model.programs[program].first; block < change; block = block.next()) {
    if (hidden.isIn(block))
      return {};
    for (const Word &word : context.tree.wordsOf(block)) {
      const Code *code = word.isCode() ? codeOf(word, context.dialect) : nullptr;
      if (word.address() == 'S')
        early.speed = &word;
      else if (isOneOf(code, kStarting))
        early.start = &word;
      else if (isOneOf(code, kDrilling) || isOneOf(code, kFeeding) || (code && code->action == CodeAction::SpindleStop))
        return {};
    }
  }
  return early.start && early.speed ? early : EarlyStart{};
}

/// `M03 S300`, `M06 T04`, and cuts without another M03 in the whole program.
void checkEarly(std::span<const Section> sections, BlockId change, ProgramId program, const FileContext &context,
                const Reporter &reporter) {
  const bool isStarted = std::ranges::any_of(sections, [](const Section &section) { return section.start != nullptr; });
  if (sections.empty() || isStarted || sections.front().mayStartUnseen || !sections.front().cut)
    return;
  const EarlyStart early = startBefore(change, program, context);
  if (early.start)
    reporter.report(
        {.message = fmt::format("no `M03` or `M04` comes between {} and this cut",
                                context.quoted(sections.front().change->span())),
         .span = sections.front().cut->span(),
         .labels = {{early.start->span(), "started before the tool change"},
                    {sections.front().change->span(), "the spindle stops for the tool change"}},
         .notes = {"the tool is fed into the part with the spindle stopped",
                   fmt::format("write {} and S behind the tool change", context.quoted(early.start->span()))}});
}

/// A macro that changes the tool and then cuts: whatever its caller has started stands since the change.
void checkMacro(const Section &section, ProgramId program, const FileContext &context, const Reporter &reporter) {
  const Program &its = context.model.programs[program];
  if (!its.returns || !its.name.number || context.dialect.grammar.oWords || section.mayStartUnseen || section.start ||
      !section.cut)
    return;
  const bool readsArguments = std::ranges::any_of(context.model.variablesOf(program), [](const VariableUse &use) {
    return use.number && *use.number > 0 && *use.number <= kLocalVariables;
  });
  if (readsArguments)
    reporter.report({.message = fmt::format("no `M03` or `M04` comes between {} and this cut",
                                            context.quoted(section.change->span())),
                     .span = section.cut->span(),
                     .labels = {{section.change->span(), "the spindle stops for the tool change"}},
                     .notes = {"the tool is fed into the part with the spindle stopped",
                               "start the spindle with S and M03 before this cut"}});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling)
    return;
  const Reader reader(program, context);
  std::vector<Section> sections;
  const std::vector<ToolSection> tools = toolSectionsOf(program, context);
  for (const ToolSection &tool : tools)
    sections.push_back(reader.read(tool, sections.empty() ? nullptr : sections.back().lateSpeed));
  const auto starts = [](const Section &section) { return section.start && section.speed && section.cut; };
  const auto like = std::ranges::find_if(sections, starts);
  if (like == sections.end()) {
    if (!tools.empty())
      checkEarly(sections, tools.front().first, program, context, reporter);
    if (sections.size() == 1)
      checkMacro(sections.front(), program, context, reporter);
    return;
  }
  const auto others = std::ranges::count_if(sections, starts);
  constexpr std::ptrdiff_t kHabit = 2;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const Section &section = sections[i];
    if (!section.cut || section.mayStartUnseen)
      continue;
    if (!section.start && (section.speed || section.cutsForSure))
      tellStart(section, *like, context, reporter);
    else if (section.start && !section.speed && i > 0 && others >= kHabit)
      tellSpeed(section, *like, context, reporter);
  }
}

} // namespace

extern const Rule spindleNotRestarted;
const Rule spindleNotRestarted{
    .info = {"spindle-not-restarted", Category::Motion, Severity::Warning,
             "Reports a tool that cuts without an `M03` or an `S` behind its tool change, in a macro, or when other "
             "tools of the program have them."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::spindle_not_restarted
