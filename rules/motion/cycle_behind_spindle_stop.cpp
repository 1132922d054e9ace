// cycle-behind-spindle-stop: `G43 Z25. H01 M05`, then `G81`.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace feedhold::rules::cycle_behind_spindle_stop {
namespace {

constexpr std::array kDrilling = {CodeAction::CycleDrill,     CodeAction::CycleDwell,   CodeAction::CyclePeck,
                                  CodeAction::CycleChipBreak, CodeAction::CycleBore,    CodeAction::CycleBoreStop,
                                  CodeAction::CycleBoreDwell, CodeAction::CycleFineBore};
constexpr std::array kTapping = {CodeAction::CycleTap, CodeAction::CycleTapLeft};
constexpr std::array kStarting = {CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise};
constexpr std::array kCutting = {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise};

/// Follows M03, M05 and cycles through the text of one program, so that a block that cannot be read hides nothing else.
class Reader {
public:
  Reader(ProgramId program, const FileContext &context)
      : context_(context), targets_(context.model.jumpTargetsOf(program)) {}

  void read(BlockId block, const Reporter &reporter) {
    if (targets_.contains(block) || !context_.model.callsIn(block, block.next()).empty() ||
        context_.tree.blocks[block].has(Block::kSkip))
      forget();
    for (const Word &word : context_.tree.wordsOf(block))
      if (word.isCode())
        readCode(word, reporter);
    if (flowAfter(context_.tree, block, context_.dialect) != FlowAfter::Next)
      forget();
  }

private:
  void forget() {
    stop_ = nullptr;
    start_ = nullptr;
    isUnused_ = false;
  }

  void readCode(const Word &word, const Reporter &reporter) {
    const Code *code = codeOf(word, context_.dialect);
    const auto does = [&](const auto &actions) {
      return code && std::ranges::find(actions, code->action) != actions.end();
    };
    const bool mayStartSpindle = word.address() == 'M' && (!code || code->action == CodeAction::Unclassified);
    if (mayStartSpindle || does(std::array{CodeAction::ToolChange, CodeAction::Anything})) {
      forget();
    } else if (does(kStarting)) {
      stop_ = nullptr;
      start_ = &word;
    } else if (does(std::array{CodeAction::SpindleStop})) {
      isUnused_ = start_ != nullptr; // no cut since the start
      stop_ = &word;
    } else if (does(kCutting)) {
      start_ = nullptr;
    } else if (does(kDrilling) || does(kTapping)) {
      // Rigid tapping starts the spindle by itself.
      if (stop_ && (does(kDrilling) || isUnused_))
        tell(word, reporter);
      forget();
    }
  }

  void tell(const Word &cycle, const Reporter &reporter) const {
    std::vector<Label> labels{{cycle.span(), "the cycle"}};
    if (isUnused_)
      labels.push_back({start_->span(), "started here"});
    reporter.report({.message = fmt::format("{} stops the spindle, and {} follows without a start",
                                            context_.quoted(stop_->span()), context_.quoted(cycle.span())),
                     .span = stop_->span(),
                     .labels = std::move(labels),
                     .notes = {"the cycle drives the tool into the part with the spindle stopped",
                               "if coolant is meant, write M08; else start the spindle before the cycle"}});
  }

  const FileContext &context_;
  std::set<BlockId> targets_;
  const Word *stop_ = nullptr;
  const Word *start_ = nullptr; // before it, without a cut between
  bool isUnused_ = false;
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling)
    return;
  Reader reader(program, context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    reader.read(block, reporter);
}

} // namespace

extern const Rule cycleBehindSpindleStop;
const Rule cycleBehindSpindleStop{.info = {"cycle-behind-spindle-stop", Category::Motion, Severity::Warning,
                                           "Reports an `M05` behind which a drilling cycle follows without `M03` or "
                                           "`M04`."},
                                  .hooks = {.program = check}};

} // namespace feedhold::rules::cycle_behind_spindle_stop
