// rapid-onto-diameter: `G01 X45. Z-54.`, the next tool, and `G00 X45. Z-8.`: it arrives on the surface at rapid.
#include "rules/comments/remarks_of_block.h"
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace feedhold::rules::rapid_onto_diameter {
namespace {

/// By the way on which the tool leaves it: away from the centre, or towards it.
enum class Side : std::uint8_t { Unknown, Outside, Bore };

/// Cut along Z at one diameter.
struct Surface {
  double x;
  double from; // the larger Z
  double to;
  std::size_t tool; // which one cut it, counted through the program
  const Block *block;
  Side side = Side::Unknown;
};

class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), walk_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    if (findWord(context_.tree, block, 'T')) {
      ++tool_;
      open_ = surfaces_.size();
      isBar_ = speaksOfBoringBar(remarksOf(context_, block));
    }
    const TurningPoint before = walk_.at();
    const TurningMove move = walk_.read(block);
    const TurningPoint &at = walk_.at();
    if (move == TurningMove::Cycle)
      noteContour(block, before);
    const bool moves = move == TurningMove::Feed || move == TurningMove::Rapid;
    if (moves && before.x && at.x && *before.x != *at.x)
      close(*at.x > *before.x ? Side::Outside : Side::Bore, before.z);
    if (move == TurningMove::Feed)
      noteSurface(before, at, &context_.tree.blocks[block]);
    if (move == TurningMove::Rapid)
      judge(block, at, reporter);
  }

private:
  /// The tool leaves what it has cut since it came there, from a place beside it.
  void close(Side side, const std::optional<double> &z) {
    for (; open_ < surfaces_.size(); ++open_)
      if (surfaces_[open_].side == Side::Unknown && (!z || (*z < surfaces_[open_].from && *z >= surfaces_[open_].to)))
        surfaces_[open_].side = side;
  }
  void noteSurface(const TurningPoint &from, const TurningPoint &to, const Block *block) {
    if (from.x && to.x && from.z && to.z && *from.x == *to.x && *from.x > 0 && *from.z != *to.z)
      surfaces_.push_back({*to.x, std::max(*from.z, *to.z), std::min(*from.z, *to.z), tool_, block,
                           isBar_ ? Side::Bore : Side::Unknown});
  }
  /// What a finishing cycle leaves is the contour itself.
  void noteContour(BlockId block, const TurningPoint &start) {
    const Word *finish = findAction(context_.tree, block, context_.dialect, {CodeAction::FinishContour});
    for (const Contour &contour : walk_.contours()) {
      if (!finish || contour.cycle->block != block)
        continue;
      TurningPoint last = start;
      const auto corners = walk_.cornersOf(contour, start);
      for (const TurningPoint &corner : corners) {
        noteSurface(last, corner, &context_.tree.blocks[block]);
        last = corner;
      }
      const auto isInside = [&](const TurningPoint &corner) { return *corner.x <= *start.x; };
      close(!start.x                                 ? Side::Unknown
            : std::ranges::all_of(corners, isInside) ? Side::Outside
                                                     : Side::Bore,
            std::nullopt);
    }
  }
  static bool covers(const Surface &surface, double z) { return z < std::min(surface.from, 0.) && z > surface.to; }
  /// No other pass went deeper there, or may have been one of the other side.
  bool isLast(const Surface &surface, double z) const {
    return std::ranges::none_of(surfaces_, [&](const Surface &other) {
      if (!covers(other, z) || other.x == surface.x)
        return false;
      if (surface.side == Side::Unknown || other.side == Side::Unknown)
        return true;
      return other.side == surface.side && (other.x < surface.x) == (surface.side == Side::Outside);
    });
  }
  void judge(BlockId block, const TurningPoint &at, const Reporter &reporter) {
    if (!at.x || !at.z)
      return;
    const Surface *met = nullptr;
    for (const Surface &surface : surfaces_)
      if (covers(surface, *at.z) && surface.x == *at.x && surface.tool != tool_ && isLast(surface, *at.z))
        met = &surface;
    const Word *word = findWord(context_.tree, block, 'X');
    word = word ? word : findWord(context_.tree, block, 'Z');
    if (!met || !word || told_ == tool_)
      return;
    told_ = tool_;
    reporter.report({.message = fmt::format("the rapid move to X{:g} Z{:g} ends on the diameter that was turned before",
                                            *at.x, *at.z),
                     .span = word->span(),
                     .labels = {{met->block->span(), "turned to this diameter here"}},
                     .notes = {"the tool arrives at rapid with no clearance, and hits or scores the surface",
                               "stop clear of the diameter, and go on at feed"}});
  }

  const FileContext &context_;
  TurningWalk walk_;
  std::vector<Surface> surfaces_;
  std::size_t tool_ = 0;
  bool isBar_ = false;              // a boring bar, as the remark of its T word says
  std::size_t open_ = 0;            // the first surface whose side is not known yet
  std::optional<std::size_t> told_; // for this tool
};

} // namespace

extern const Rule rapidOntoDiameter;
const Rule rapidOntoDiameter{.info = {"rapid-onto-diameter", Category::Motion, Severity::Warning,
                                      "Reports a rapid move of a lathe that ends on a diameter which an earlier tool "
                                      "has turned."},
                             .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::rapid_onto_diameter
