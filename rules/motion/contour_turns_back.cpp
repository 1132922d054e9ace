// contour-turns-back: `G72`, and a contour that goes to Z-10., then to Z-5.
#include "rules/motion/turning_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

namespace feedhold::rules::contour_turns_back {
namespace {

/// mm or inch: less is a slip of a drawing.
constexpr double kClearly = 0.01;

enum class Along : std::uint8_t { X, Z };

/// From a start on one side of the contour, the first block goes to where the infeed ends: the contour leads back from
/// there.  0: the start does not tell.
double directionFrom(const std::optional<double> &start, const std::vector<double> &contour) {
  const auto lies = [&](auto compare) {
    return start && std::ranges::all_of(contour, [&](double at) { return compare(*start, at); });
  };
  if (!lies(std::greater_equal<>()) && !lies(std::less_equal<>()))
    return 0;
  const double back = *start - contour.front();
  return std::abs(back) > kClearly ? back : 0;
}

std::vector<double> along(const std::vector<TurningPoint> &corners, Along axis) {
  std::vector<double> coordinates;
  for (const TurningPoint &corner : corners)
    coordinates.push_back(axis == Along::X ? *corner.x : *corner.z);
  return coordinates;
}

/// The block in which the contour first goes against the direction that it has had along the axis.
std::optional<std::size_t> turnOf(const std::vector<double> &corners, double direction) {
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double step = corners[i] - corners[i - 1];
    if (std::abs(step) <= kClearly)
      continue;
    if (direction * step < 0)
      return i;
    direction = step;
  }
  return std::nullopt;
}

/// The last block goes back along the way that the blocks before it cut: at the same X, or the same Z of a face.
bool dragsBack(const std::vector<TurningPoint> &corners, Along axis) {
  const auto across = [&](std::size_t i) { return axis == Along::X ? *corners[i].z : *corners[i].x; };
  const std::size_t last = corners.size() - 1;
  return across(last) == across(last - 1) && across(last - 1) == across(last - 2);
}

/// Nothing but moves: codes of the spindle, tools or stops say that the sequence numbers are those of something else.
bool isPlain(const Contour &contour, const FileContext &context) {
  for (BlockId block = contour.first; block <= contour.last; block = block.next())
    for (const char address : {'M', 'T', 'S'})
      if (findWord(context.tree, block, address))
        return false;
  return true;
}

/// The blocks of a contour that cornersOf tells a corner of.
std::vector<BlockId> blocksOf(const Contour &contour, const FileContext &context) {
  std::vector<BlockId> blocks;
  for (BlockId block = contour.first; block <= contour.last; block = block.next())
    for (const char axis : {'X', 'Z', 'U', 'W'})
      if (findWord(context.tree, block, axis)) {
        blocks.push_back(block);
        break;
      }
  return blocks;
}

void judge(const Contour &contour, const TurningPoint &start, const TurningWalk &walk, const FileContext &context,
           const Reporter &reporter) {
  const BlockId cycle = contour.cycle->block;
  const Word *word = findCode(context.tree, cycle, context.dialect, CodeRole::Contour);
  const Code *code = word ? codeOf(*word, context.dialect) : nullptr;
  const bool isFacing = code && code->action == CodeAction::FaceContour;
  if (!isFacing && !(code && code->action == CodeAction::TurnContour))
    return;
  const auto corners = walk.cornersOf(contour, start);
  const auto blocks = blocksOf(contour, context);
  if (corners.size() < 3 || corners.size() != blocks.size() || !isPlain(contour, context))
    return;
  // With both axes in its first block a contour is one of type II, which may turn back across the cuts.
  const auto hasFirst = [&](char a, char b) {
    return findWord(context.tree, blocks.front(), a) || findWord(context.tree, blocks.front(), b);
  };
  const bool isPocket = hasFirst('X', 'U') && hasFirst('Z', 'W');
  for (const Along axis : {Along::X, Along::Z}) {
    const bool isAcross = (axis == Along::X) != isFacing; // the direction of the infeed
    const std::vector<double> coordinates = along(corners, axis);
    const double direction = isAcross ? directionFrom(axis == Along::X ? start.x : start.z, coordinates) : 0;
    const auto turn = isPocket && isAcross ? std::nullopt : turnOf(coordinates, direction);
    // The last block may go back to the start at rapid, where the compensation ends; not along what was just cut.
    if (!turn ||
        (blocks[*turn] == contour.last &&
         findAction(context.tree, contour.last, context.dialect, {CodeAction::Rapid}) && !dragsBack(corners, axis)))
      continue;
    reporter.report(
        {.message = fmt::format("the contour of {} turns back in {} here", context.quoted(word->span()),
                                axis == Along::X ? 'X' : 'Z'),
         .span = context.tree.blocks[blocks[*turn]].span(),
         .labels = {{context.tree.blocks[cycle].span(), "its cycle"}},
         .notes = {"the cycle cuts contours that go one way along both axes: the control stops, or cuts into the part",
                   isAcross ? "a contour with a pocket begins with X and Z in its first block (type II)"
                            : "correct the coordinate"}});
    return;
  }
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  TurningWalk walk(program, context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    const TurningPoint start = walk.at();
    walk.read(block);
    for (const Contour &contour : walk.contours())
      if (contour.cycle->block == block && contour.standsBehindCycle())
        judge(contour, start, walk, context, reporter);
  }
}

} // namespace

extern const Rule contourTurnsBack;
const Rule contourTurnsBack{.info = {"contour-turns-back", Category::Motion, Severity::Warning,
                                     "Reports a contour of a roughing cycle that goes back along an axis where the "
                                     "cycle cuts one way only."},
                            .hooks = {.program = check}};

} // namespace feedhold::rules::contour_turns_back
