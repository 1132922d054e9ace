// coolant-off-at-change: `M08`, and later `M06 T8` and cuts, and no other `M08`.
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::rules::coolant_off_at_change {
namespace {

constexpr std::array kCutting = {CodeAction::Linear,     CodeAction::ArcClockwise,  CodeAction::ArcCounterclockwise,
                                 CodeAction::CycleDrill, CodeAction::CycleDwell,    CodeAction::CyclePeck,
                                 CodeAction::CycleTap,   CodeAction::CycleChipBreak};
constexpr std::array kSpindle = {CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise,
                                 CodeAction::SpindleStop};
constexpr std::array kKnown = {CodeAction::ToolChange, CodeAction::CoolantOff};

template <std::size_t kSize> bool isOneOf(const Code *code, const std::array<CodeAction, kSize> &actions) {
  return code && std::ranges::find(actions, code->action) != actions.end();
}

/// Coolant, as the text of the program has it.
class Reader {
public:
  explicit Reader(const FileContext &context) : context_(context) {}

  void read(BlockId block) {
    for (const Word &word : context_.tree.wordsOf(block))
      if (word.isCode())
        readCode(word, codeOf(word, context_.dialect));
    for (const Call &call : context_.model.callsIn(block, block.next()))
      isUnknown_ = isUnknown_ || call.kind != CallKind::Local;
  }
  void report(const Reporter &reporter) const {
    if (!change_ || !cut_ || isUnknown_)
      return;
    reporter.report({.message = fmt::format("{} switches the coolant off, and nothing switches it on again",
                                            context_.quoted(change_->span())),
                     .span = change_->span(),
                     .labels = {{on_->span(), "switched on here"}, {cut_->span(), "the cut behind it"}},
                     .notes = {"the tool cuts dry: it may wear out or break", "write `M08` behind the tool change"}});
  }

private:
  void readCode(const Word &word, const Code *code) {
    if (code && code->action == CodeAction::CoolantOn) {
      // Another one: the programmer knows of it, and means the tools without it to cut dry.
      isUnknown_ = isUnknown_ || on_ != nullptr;
      on_ = &word;
    } else if (code && code->action == CodeAction::CoolantOff && !change_) {
      isUnknown_ = isUnknown_ || on_ != nullptr;
    } else if (code && code->action == CodeAction::ToolChange && turns_ && on_ && !change_) {
      change_ = &word;
    } else if (isOneOf(code, kSpindle)) {
      turns_ = code->action != CodeAction::SpindleStop;
    } else if (isOneOf(code, kCutting) && change_ && !cut_) {
      cut_ = &word;
    } else if (word.address() == 'M' && !isHarmless(code)) {
      isUnknown_ = true;
    }
  }
  static bool isHarmless(const Code *code) {
    return code && (isOneOf(code, kKnown) || code->role == CodeRole::ProgramEnd || code->role == CodeRole::Return ||
                    code->role == CodeRole::ProgramStop || code->role == CodeRole::LocalCall);
  }

  const FileContext &context_;
  const Word *on_ = nullptr;     // the only M08
  const Word *change_ = nullptr; // the first tool change behind it with the spindle running
  const Word *cut_ = nullptr;    // the first cut behind that
  bool turns_ = false;           // the spindle
  bool isUnknown_ = false;       // something may switch the coolant unseen, or it is meant so
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.behaviour.toolChangeStopsCoolant)
    return;
  Reader reader(context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    reader.read(block);
  reader.report(reporter);
}

} // namespace

extern const Rule coolantOffAtChange;
const Rule coolantOffAtChange{
    .info = {"coolant-off-at-change", Category::Motion, Severity::Warning,
             "Reports coolant that is switched on before a tool change that switches it off, and nowhere behind it."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::coolant_off_at_change
