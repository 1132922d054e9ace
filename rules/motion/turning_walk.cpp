// See the header.
#include "rules/motion/turning_walk.h"

#include <algorithm>
#include <array>
#include <utility>

namespace feedhold::rules {
namespace {

/// Other words of the block belong to the code, or nothing is known of the position behind it.
bool takesAway(const Code &code) {
  constexpr std::array kHarmless = {CodeRole::Plain,   CodeRole::Motion,      CodeRole::Arc,  CodeRole::CannedCycle,
                                    CodeRole::Contour, CodeRole::ProgramStop, CodeRole::Dwell};
  constexpr std::array kOther = {CodeAction::Unmodelled, CodeAction::Anything,   CodeAction::OtherCycle,
                                 CodeAction::OtherCurve, CodeAction::WorkOffset, CodeAction::ExtendedWorkOffset};
  return std::ranges::find(kHarmless, code.role) == kHarmless.end() ||
         std::ranges::find(kOther, code.action) != kOther.end();
}

/// The movement that a code puts in force; absent: none.
std::optional<TurningMove> moveOf(CodeAction action) {
  if (isTurningCycle(action))
    return TurningMove::Cycle;
  constexpr std::array kMoves = {std::pair{CodeAction::Rapid, TurningMove::Rapid},
                                 std::pair{CodeAction::Linear, TurningMove::Feed},
                                 std::pair{CodeAction::ArcClockwise, TurningMove::Feed},
                                 std::pair{CodeAction::ArcCounterclockwise, TurningMove::Feed},
                                 std::pair{CodeAction::Thread, TurningMove::Feed},
                                 std::pair{CodeAction::SideCycle, TurningMove::Unknown},
                                 std::pair{CodeAction::CycleOff, TurningMove::Unknown}};
  const auto found = std::ranges::find(kMoves, action, &std::pair<CodeAction, TurningMove>::first);
  return found == kMoves.end() ? std::nullopt : std::optional(found->second);
}

bool namesAxis(const SyntaxTree &tree, BlockId block) {
  return std::ranges::any_of(tree.wordsOf(block), [](const Word &word) {
    return word.address() == 'X' || word.address() == 'Z' || word.address() == 'U' || word.address() == 'W';
  });
}

} // namespace

bool cutsThread(const Code &code) {
  return code.action == CodeAction::Thread || code.action == CodeAction::ThreadCycle ||
         code.action == CodeAction::ThreadPasses;
}

bool drillsAlongZ(const Word &word, const FileContext &context) {
  if (word.address() != 'G' || !word.isNumber())
    return false;
  const Code *code = codeOf(word, context.dialect);
  if (code && code->action == CodeAction::FaceGroove)
    return true;
  const auto number = word.integer();
  const bool isOfDrilling = number && ((*number >= 81 && *number <= 85) || *number == 89);
  return isOfDrilling && (!code || code->role == CodeRole::CannedCycle);
}

std::optional<SpeedLimit> speedLimitIn(BlockId block, const FileContext &context) {
  // Programs write the limit of another code system than that of their other codes.
  const bool isAlone = !namesAxis(context.tree, block);
  const auto isLimit = [&](const Word &word) {
    const Code *code = word.isCode() ? codeOf(word, context.dialect) : nullptr;
    const bool isCode = word.address() == 'G' && word.isNumber();
    return (code && code->action == CodeAction::CoordinateSet) || (isCode && word.tenths() == 500) ||
           (isCode && word.tenths() == 920 && isAlone);
  };
  const auto words = context.tree.wordsOf(block);
  const auto limit = std::ranges::find_if(words, isLimit);
  const Word *speed = findWord(context.tree, block, 'S');
  return limit == words.end() || !speed ? std::nullopt : std::optional(SpeedLimit{&*limit, speed});
}

bool isOfBore(const std::vector<TurningPoint> &corners) {
  const auto x = [](const TurningPoint &corner) { return *corner.x; };
  const auto deepest = std::ranges::min_element(corners, {}, [](const TurningPoint &corner) { return *corner.z; });
  return deepest != corners.end() && std::ranges::is_sorted(corners, std::ranges::greater{}, x) &&
         *deepest->x < *corners.front().x;
}

TurningWalk::TurningWalk(ProgramId program, const FileContext &context)
    : context_(context), hidden_(program, context), contours_(contoursOf(program, context)) {}

/// Behind a cycle the control goes on after the contour that stands there: blocks before it are passed over, too.
bool TurningWalk::isInContour(BlockId block) const {
  return std::ranges::any_of(contours_, [&](const Contour &contour) {
    return contour.standsBehindCycle() && contour.cycle->block < block && block <= contour.last;
  });
}

std::optional<double> TurningWalk::coordinate(const Word &word) const {
  const bool isPlain =
      word.isNumber() && !word.has(Word::kArgument) &&
      (word.has(Word::kPoint) || word.number().isZero() || context_.dialect.switches.dpi == Switch::On);
  return isPlain ? std::optional(word.number().toDouble()) : std::nullopt;
}

void TurningWalk::moveTo(BlockId block, TurningPoint &point) const {
  for (const Word &word : context_.tree.wordsOf(block)) {
    const bool isAcross = word.address() == 'X' || word.address() == 'U';
    if ((!isAcross && word.address() != 'Z' && word.address() != 'W') || word.has(Word::kComma))
      continue;
    std::optional<double> &axis = isAcross ? point.x : point.z;
    const bool isDistance = isIncremental_ || word.address() == 'U' || word.address() == 'W';
    const auto value = coordinate(word);
    axis = !value ? std::nullopt : !isDistance ? value : axis ? std::optional(*axis + *value) : std::nullopt;
  }
}

/// False: nothing is known behind the block.
bool TurningWalk::follow(const Word &word) {
  const Code *code = codeOf(word, context_.dialect);
  if (!code) // M41 and its like switch something
    return word.address() == 'M' && word.isNumber() && word.tenths().value_or(1000) < 1000;
  if (code->action == CodeAction::Absolute || code->action == CodeAction::Incremental)
    isIncremental_ = code->action == CodeAction::Incremental;
  if (code->action == CodeAction::DiameterCycle) // `G90` of code system A, in a program that also has G91
    isIncremental_ = false;
  if (code->action == CodeAction::Metric || code->action == CodeAction::Inch)
    isMetric_ = code->action == CodeAction::Metric;
  const auto move = moveOf(code->action);
  motion_ = move.value_or(motion_);
  return move || code->action == CodeAction::CoordinateSet || !takesAway(*code); // `G50 S2000` moves nothing
}

TurningMove TurningWalk::read(BlockId block) {
  if (isInContour(block))
    return TurningMove::None;
  if (hidden_.isIn(block))
    lose();
  const bool moves = namesAxis(context_.tree, block);
  bool isFollowed = true;
  for (const Word &word : context_.tree.wordsOf(block))
    isFollowed = (!word.isCode() || follow(word)) && isFollowed;
  const bool setsPosition =
      moves && findAction(context_.tree, block, context_.dialect, {CodeAction::CoordinateSet}) != nullptr;
  if (!isFollowed || setsPosition || flowAfter(context_.tree, block, context_.dialect) >= FlowAfter::Jumps) {
    lose();
    return TurningMove::None;
  }
  const Word *cycle = findTurningCycle(context_.tree, block, context_.dialect);
  const bool isOfGroup = !cycle || codeOf(*cycle, context_.dialect)->group != 0;
  if (!isOfGroup || motion_ == TurningMove::Cycle) {
    if (!isOfGroup)
      motion_ = TurningMove::Unknown; // the control may go on at rapid or at feed
    return cycle || moves ? TurningMove::Cycle : TurningMove::None;
  }
  if (!moves || findCode(context_.tree, block, context_.dialect, CodeRole::Dwell))
    return TurningMove::None;
  moveTo(block, at_);
  return motion_;
}

TurningPoint TurningWalk::endOf(BlockId block) const {
  TurningPoint point = at_;
  moveTo(block, point);
  return point;
}

std::vector<TurningPoint> TurningWalk::cornersOf(const Contour &contour, const TurningPoint &start) const {
  std::vector<TurningPoint> corners;
  TurningPoint point = start;
  for (BlockId block = contour.first; block <= contour.last; block = block.next()) {
    if (!namesAxis(context_.tree, block))
      continue;
    moveTo(block, point);
    if (!point.x || !point.z)
      return {};
    corners.push_back(point);
  }
  return corners;
}

} // namespace feedhold::rules
