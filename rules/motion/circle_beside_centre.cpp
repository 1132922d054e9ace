// circle-beside-centre: `G03 I0 J-.345` about Y-4.53, and then `G01 Y-4.5`, to the centre of the other circles.
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace feedhold::rules::circle_beside_centre {
namespace {

struct Point {
  double x;
  double y;
};

double distance(const Point &one, const Point &other) { return std::hypot(one.x - other.x, one.y - other.y); }

struct Circle {
  BlockId block;
  Point centre;
  double radius;
  std::optional<Point> next; // to which the tool is fed behind it
  BlockId nextBlock;
};

/// Follows X and Y through blocks that stand one behind the other.
class Walk {
public:
  explicit Walk(const FileContext &context) : context_(context) {}

  void read(BlockId block) {
    const SyntaxTree &tree = context_.tree;
    if (tree.wordsOf(block).empty() && tree.statementsOf(block).empty() && !tree.blocks[block].has(Block::kBroken))
      return;
    if (!isPlain(block))
      return lose();
    if (findAction(tree, block, context_.dialect, {CodeAction::WorkOffset}))
      lose();
    const std::size_t before = circles_.size();
    if (const Word *arc = findCode(tree, block, context_.dialect, CodeRole::Arc))
      readArc(block, *arc);
    const auto x = coordinate(block, 'X', x_);
    const auto y = coordinate(block, 'Y', y_);
    const bool moves = findWord(tree, block, 'X') || findWord(tree, block, 'Y');
    x_ = x;
    y_ = y;
    if (circles_.size() > before || !moves)
      return;
    if (open_ && isLine(block) && x_ && y_) {
      circles_.back().next = Point{*x_, *y_};
      circles_.back().nextBlock = block;
    }
    open_ = false;
  }

  const std::vector<Circle> &circles() const { return circles_; }

private:
  /// Absolute coordinates of the XY plane that are numbers.
  bool isPlain(BlockId block) {
    const SyntaxTree &tree = context_.tree;
    if (!tree.statementsOf(block).empty() || tree.blocks[block].has(Block::kBroken) ||
        tree.blocks[block].has(Block::kSkip) || !context_.model.callsIn(block, block.next()).empty() ||
        meansOwnWords(tree, block, context_.dialect))
      return false;
    if (findAction(tree, block, context_.dialect, {CodeAction::Absolute}))
      isAbsolute_ = true;
    if (findAction(tree, block, context_.dialect, {CodeAction::Incremental}))
      isAbsolute_ = false;
    const bool turns = findAction(tree, block, context_.dialect,
                                  {CodeAction::LocalShift, CodeAction::CoordinateSet, CodeAction::Anything,
                                   CodeAction::Unmodelled, CodeAction::ArcAbsolute}) ||
                       findCode(tree, block, context_.dialect, CodeRole::ReferenceReturn) ||
                       findCode(tree, block, context_.dialect, CodeRole::MachinePosition);
    return isAbsolute_ && !turns;
  }
  void lose() {
    x_.reset();
    y_.reset();
    open_ = false;
  }
  std::optional<double> valueOf(const Word &word) const {
    const bool isExact = word.isNumber() && (word.has(Word::kPoint) || word.number().isZero() ||
                                             context_.dialect.switches.dpi == Switch::On);
    return isExact ? std::optional(word.number().toDouble()) : std::nullopt;
  }
  std::optional<double> coordinate(BlockId block, char axis, const std::optional<double> &before) const {
    const Word *word = findWord(context_.tree, block, axis);
    return word ? valueOf(*word) : before;
  }
  bool isLine(BlockId block) const {
    return findAction(context_.tree, block, context_.dialect, {CodeAction::Linear}) &&
           !findWord(context_.tree, block, 'I') && !findWord(context_.tree, block, 'J');
  }
  /// A full circle: it names no end point.
  void readArc(BlockId block, const Word &arc) {
    open_ = false;
    const auto i = coordinate(block, 'I', 0.0);
    const auto j = coordinate(block, 'J', 0.0);
    const bool isFull = !findWord(context_.tree, block, 'X') && !findWord(context_.tree, block, 'Y') &&
                        !findWord(context_.tree, block, 'R') && !findWord(context_.tree, block, 'K');
    if (!isFull || !x_ || !y_ || !i || !j || (*i == 0 && *j == 0) || !arc.isCode())
      return;
    circles_.push_back({.block = block,
                        .centre = {*x_ + *i, *y_ + *j},
                        .radius = std::hypot(*i, *j),
                        .next = std::nullopt,
                        .nextBlock = block});
    open_ = true;
  }

  const FileContext &context_;
  std::vector<Circle> circles_;
  std::optional<double> x_;
  std::optional<double> y_;
  bool isAbsolute_ = true;
  bool open_ = false; // nothing has moved in the plane behind the last circle
};

/// Farther apart than rounding explains, and so near that the same place is meant.
bool misses(const Circle &circle) {
  constexpr double kRounding = 0.01;
  constexpr double kNear = 0.12;
  const double apart = circle.next ? distance(circle.centre, *circle.next) : 0;
  return apart > kRounding * circle.radius && apart < kNear * circle.radius;
}

constexpr double kSame = 1e-6;

std::size_t countAbout(const Point &point, const std::vector<Circle> &circles) {
  return static_cast<std::size_t>(
      std::ranges::count_if(circles, [&](const Circle &each) { return distance(each.centre, point) < kSame; }));
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling)
    return;
  const Program &its = context.model.programs[program];
  Walk walk(context);
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    if (findAction(context.tree, block, context.dialect, {CodeAction::PlaneZX, CodeAction::PlaneYZ}))
      return;
    walk.read(block);
  }
  const auto &circles = walk.circles();
  for (const Circle &circle : circles) {
    if (!misses(circle) || countAbout(circle.centre, circles) > 1)
      continue;
    const auto other =
        std::ranges::find_if(circles, [&](const Circle &each) { return distance(each.centre, *circle.next) < kSame; });
    if (other == circles.end())
      continue;
    const bool isX = std::abs(circle.centre.x - circle.next->x) > std::abs(circle.centre.y - circle.next->y);
    reporter.report(
        {.message = isX ? fmt::format("the centre of this circle is X{:g}, not X{:g}", circle.centre.x, circle.next->x)
                        : fmt::format("the centre of this circle is Y{:g}, not Y{:g}", circle.centre.y, circle.next->y),
         .span = context.tree.blocks[circle.block].span(),
         .labels = {{context.tree.blocks[circle.nextBlock].span(), "to the centre that was meant"},
                    {context.tree.blocks[other->block].span(), "a circle about that centre"}},
         .notes = {"the bore is off its place by the difference: the start point or the distance of the centre has a "
                   "wrong digit"}});
  }
}

} // namespace

extern const Rule circleBesideCentre;
const Rule circleBesideCentre{
    .info = {"circle-beside-centre", Category::Motion, Severity::Warning,
             "Reports a full circle whose centre is a little off the point to which the tool is fed behind it, about "
             "which another circle goes."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::circle_beside_centre
