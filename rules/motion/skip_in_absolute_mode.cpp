// skip-in-absolute-mode: `G91 G31 X[#7/2]`, `G31 X-[#7/2]`, and in another place `G90`, `G31 Y[#7/2]`.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace feedhold::rules::skip_in_absolute_mode {
namespace {

/// A skip move along one axis.
struct SkipMove {
  BlockId block;
  const Word *axis;
  const Word *mode; // the G90 or G91 above it in the text
  bool isIncremental;
};

/// `X[#7/2]` and `Y-[#7/2]`, without the axis and the signs: empty where no variable is in it.
std::string distanceOf(const Word &word, const FileContext &context) {
  std::string text(context.text(word.span()).substr(1));
  std::erase_if(text, [](char each) { return each == ' ' || each == '\t' || each == '-' || each == '+'; });
  return text.find('#') == std::string::npos ? std::string() : text;
}

bool isSkipMove(BlockId block, const FileContext &context) {
  return findAction(context.tree, block, context.dialect, {CodeAction::Skip}) != nullptr;
}

/// The only axis of the block.
const Word *axisIn(BlockId block, const FileContext &context) {
  const Word *found = nullptr;
  for (const Word &word : context.tree.wordsOf(block))
    if (axisOf(word.address())) {
      if (found || word.form() != WordForm::Expression)
        return nullptr;
      found = &word;
    }
  return found;
}

/// By their distances; a block that jumps or to which others jump hides which mode is active.
std::map<std::string, std::vector<SkipMove>> movesOf(ProgramId program, const FileContext &context) {
  std::map<std::string, std::vector<SkipMove>> moves;
  const Program &its = context.model.programs[program];
  const Word *mode = nullptr;
  bool isIncremental = false;
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    if (flowAfter(context.tree, block, context.dialect) != FlowAfter::Next || findWord(context.tree, block, 'N'))
      mode = nullptr;
    const auto set = [&](CodeAction action) { return findAction(context.tree, block, context.dialect, {action}); };
    if (const Word *absolute = set(CodeAction::Absolute)) {
      mode = absolute;
      isIncremental = false;
    } else if (const Word *incremental = set(CodeAction::Incremental)) {
      mode = incremental;
      isIncremental = true;
    }
    const Word *axis = mode && isSkipMove(block, context) ? axisIn(block, context) : nullptr;
    if (const std::string distance = axis ? distanceOf(*axis, context) : ""; !distance.empty())
      moves[distance].push_back({block, axis, mode, isIncremental});
  }
  return moves;
}

/// Some variable of the distance is set in the program: it may be a position at one place and a distance at another.
bool isSet(BlockId block, ProgramId program, const FileContext &context) {
  const auto all = context.model.variablesOf(program);
  return std::ranges::any_of(context.model.variablesIn(block, block.next()), [&](const VariableUse &read) {
    const std::string_view text = context.text(context.tree.expressions[read.expression].span);
    return std::ranges::any_of(all, [&](const VariableUse &use) {
      return use.write && (use.number ? use.number == read.number
                                      : context.text(context.tree.expressions[use.expression].span) == text);
    });
  });
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  constexpr std::ptrdiff_t kHabit = 3; // incremental ones
  for (const auto &[distance, moves] : movesOf(program, context)) {
    const auto incremental = std::ranges::count_if(moves, &SkipMove::isIncremental);
    const auto absolute = std::ranges::find_if(moves, [](const SkipMove &move) { return !move.isIncremental; });
    if (incremental < kHabit || std::ssize(moves) != incremental + 1 || isSet(absolute->block, program, context))
      continue;
    const auto other = std::ranges::find_if(moves, &SkipMove::isIncremental);
    reporter.report(
        {.message = fmt::format("{} is a position here, and a distance in the other skip moves",
                                context.quoted(absolute->axis->span())),
         .span = absolute->axis->span(),
         .labels = {{absolute->mode->span(), "coordinates from here on"}, {other->axis->span(), "a distance"}},
         .notes = {
             "the probe goes to this coordinate instead of moving by the distance: it may move away from the part, "
             "or not far enough",
             fmt::format("write {} before it", context.quoted(other->mode->span()))}});
  }
}

} // namespace

extern const Rule skipInAbsoluteMode;
const Rule skipInAbsoluteMode{
    .info = {"skip-in-absolute-mode", Category::Motion, Severity::Warning,
             "Reports a skip move under `G90` by the distance that the other skip moves of the program have under "
             "`G91`."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::skip_in_absolute_mode
