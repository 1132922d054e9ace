// tool-not-changed: `T1 M06` .. a cut .. `T2`, `S2000 M03`, a cut, and no M06.
#include "rules/motion/tool_sections.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

namespace feedhold::rules::tool_not_changed {
namespace {

constexpr std::array kCutting = {CodeAction::Linear,         CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise,
                                 CodeAction::CycleDrill,     CodeAction::CycleDwell,   CodeAction::CyclePeck,
                                 CodeAction::CycleChipBreak, CodeAction::CycleTap,     CodeAction::CycleBore,
                                 CodeAction::CycleBoreStop,  CodeAction::CycleFineBore};

bool isTool(const Word &word) {
  return word.address() == 'T' && !word.has(Word::kArgument) && word.integer().value_or(0) != 0;
}

/// Follows T, M06 and the work between them through the text of one program.
class Reader {
public:
  Reader(ProgramId program, const FileContext &context, const Reporter &reporter)
      : context_(context), reporter_(reporter), hidden_(program, context) {}

  void read(BlockId block) {
    if (const Word *change = findAction(context_.tree, block, context_.dialect, {CodeAction::ToolChange})) {
      take(block);
      change_ = change;
      return;
    }
    if (hidden_.isIn(block) || hasUnknownCode(block)) {
      forget();
      return;
    }
    for (const Word &word : context_.tree.wordsOf(block)) {
      if (isTool(word))
        select(word);
      else
        work(word);
    }
  }
  /// A tool that is selected behind the last cut, or the first one, stands ready for the next part.
  void end() {
    if (selected_ && selected_->integer() != first_)
      judge();
  }

private:
  void take(BlockId block) {
    for (const Word &word : context_.tree.wordsOf(block)) {
      if (!isTool(word))
        continue;
      if (selected_ && selected_->integer() != word.integer())
        judge();
      first_ = first_ ? first_ : word.integer();
    }
    forget();
  }
  void forget() {
    selected_ = nullptr;
    hasCut_ = isPrepared_ = cutsAgain_ = false;
  }
  void select(const Word &word) {
    first_ = first_ ? first_ : word.integer();
    if (selected_ && selected_->integer() != word.integer())
      judge();
    const bool hasCut = hasCut_ || cutsAgain_;
    forget();
    hasCut_ = hasCut;
    if (change_ && hasCut)
      selected_ = &word;
  }
  void work(const Word &word) {
    const Code *code = word.isCode() ? codeOf(word, context_.dialect) : nullptr;
    const bool cuts = code && std::ranges::find(kCutting, code->action) != kCutting.end();
    // The speed of a tool that is ready in the magazine is not set yet.
    isPrepared_ = isPrepared_ || (selected_ && word.address() == 'S' && !word.has(Word::kArgument));
    hasCut_ = hasCut_ || cuts;
    cutsAgain_ = cutsAgain_ || (cuts && isPrepared_);
  }
  /// It may change the tool, as M codes of machine builders do.
  bool hasUnknownCode(BlockId block) const {
    return std::ranges::any_of(context_.tree.wordsOf(block), [&](const Word &word) {
      const Code *code = codeOf(word, context_.dialect);
      return word.isCode() && (!code || code->action == CodeAction::Anything);
    });
  }
  void judge() {
    if (!cutsAgain_)
      return;
    reporter_.report(
        {.message = fmt::format("{} selects a tool that no `M06` changes to", context_.quoted(selected_->span())),
         .span = selected_->span(),
         .labels = {{change_->span(), "the last tool change"}},
         .notes = {"the cuts behind it are made with the tool that is in the spindle", "write M06 beside it"}});
  }

  const FileContext &context_;
  const Reporter &reporter_;
  HiddenWork hidden_;
  const Word *change_ = nullptr;       // the last M06
  std::optional<std::uint32_t> first_; // the tool of the first M06
  const Word *selected_ = nullptr;     // without M06
  bool hasCut_ = false;                // since the last T or M06
  bool isPrepared_ = false;            // S behind selected_
  bool cutsAgain_ = false;             // and then a cut
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling)
    return;
  Reader reader(program, context, reporter);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    reader.read(block);
  reader.end();
}

} // namespace

extern const Rule toolNotChanged;
const Rule toolNotChanged{
    .info = {"tool-not-changed", Category::Motion, Severity::Warning,
             "Reports a `T` without `M06` before further cuts, in a program that changes its other tools by `M06`."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::tool_not_changed
