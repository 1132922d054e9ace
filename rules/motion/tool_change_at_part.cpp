// tool-change-at-part: `G01 Z-40.`, `G00 X82.`, `T0404`: the turret turns beside the part.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace feedhold::rules::tool_change_at_part {
namespace {

/// `T0404`, `T404`, `T4`: tool 4.  Absent for `T0400`, which may be a cancelled offset, and for what is computed.
std::optional<std::uint32_t> toolOf(const Word &word) {
  const auto number = word.integer();
  if (!number || word.has(Word::kArgument))
    return std::nullopt;
  return *number >= 100 ? *number / 100 : *number;
}

/// Another tool is called while the tool is at x, z, as programmed.
struct Change {
  const Word *word; // T
  double x, z;
  const Block *cut; // the last one before
  bool isNear;      // to the part along Z, and along X no further out than cuts
};

/// Forgotten: all other changes are away from the part.  By the place alone, one in front of the face may be in the
/// air.
enum class Reason : std::uint8_t { Place, Forgotten };

class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), walk_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    if (const Word *tool = findWord(context_.tree, block, 'T'))
      readTool(*tool, block, reporter);
    if (findCode(context_.tree, block, context_.dialect, CodeRole::ProgramEnd) ||
        findCode(context_.tree, block, context_.dialect, CodeRole::Return))
      tool_.reset();
    const TurningPoint before = walk_.at();
    const TurningMove move = walk_.read(block);
    if (move == TurningMove::Feed || move == TurningMove::Cycle) {
      cut_ = &context_.tree.blocks[block];
      noteReach(before.x);
      noteReach(walk_.at().x);
    }
  }

  void finish(const Reporter &reporter) const {
    constexpr std::size_t kFewestAway = 2;
    const bool isForgotten = inFront_.size() == 1 && others_ == 0 && away_ >= kFewestAway;
    for (const Change &change : inFront_)
      if (isForgotten || change.isNear)
        tell(change, isForgotten ? Reason::Forgotten : Reason::Place, reporter);
  }

private:
  void noteReach(const std::optional<double> &x) {
    if (x)
      reach_ = std::max(reach_, std::abs(*x));
  }
  /// In front of the face by less than what tools differ in length.
  bool isNearFace(double z) const { return z <= (walk_.isMetric() ? 5 : 0.2); }
  bool isAtFace(double z) const { return z <= (walk_.isMetric() ? 0.5 : 0.02); }

  void readTool(const Word &word, BlockId block, const Reporter &reporter) {
    const auto tool = toolOf(word);
    if (tool == 0U)
      return;
    if (tool && tool_ && *tool == *tool_) // another offset, or none
      return;
    if (tool && tool_ && cut_)
      readChange(word, block, reporter);
    tool_ = tool;
    cut_ = nullptr;
  }
  void readChange(const Word &word, BlockId block, const Reporter &reporter) {
    const TurningPoint &at = walk_.at();
    if (!at.x || !at.z) {
      ++away_;
      return;
    }
    const bool movesInBlock = findWord(context_.tree, block, 'X') || findWord(context_.tree, block, 'Z');
    const Change change{&word, *at.x, *at.z, cut_, std::abs(*at.x) <= reach_ && isNearFace(*at.z)};
    if (!movesInBlock && *at.z > 0 && !isAtFace(*at.z) && *at.z <= reach_) {
      inFront_.push_back(change);
      return;
    }
    ++others_;
    if (!movesInBlock && change.isNear)
      tell(change, Reason::Place, reporter);
  }

  void tell(const Change &change, Reason reason, const Reporter &reporter) const {
    const double x = change.x, z = change.z;
    const bool isBeside = z < 0;
    const bool isCertain = isBeside || isAtFace(z) || reason == Reason::Forgotten;
    Diagnostic diagnostic{.message = fmt::format("{} turns the turret at X{:g} Z{:g}, {} the part",
                                                 context_.quoted(change.word->span()), x, z,
                                                 isBeside      ? "beside"
                                                 : isAtFace(z) ? "on the face of"
                                                               : "right in front of"),
                          .span = change.word->span(),
                          .labels = {{change.cut->span(), "the last cut"}},
                          .notes = {isBeside ? "the tools that swing past hit the part or the chuck"
                                             : "a tool that is longer than this one hits the face when it swings in"}};
    if (reason == Reason::Forgotten)
      diagnostic.notes.push_back("the program calls its other tools away from the part");
    diagnostic.notes.push_back("retract first, by `G28 U0 W0` or to a safe X and Z");
    reporter.report(std::move(diagnostic), isCertain ? Severity::Warning : Severity::Info);
  }

  const FileContext &context_;
  TurningWalk walk_;
  std::optional<std::uint32_t> tool_; // in the turret's working place
  const Block *cut_ = nullptr;        // the last one with it
  double reach_ = 0;                  // the largest X at which the program cuts
  std::vector<Change> inFront_;
  std::size_t away_ = 0;   // changes at a place that is not known in coordinates of the part: home
  std::size_t others_ = 0; // changes beside the part, on its face, or far in front of it
};

} // namespace

extern const Rule toolChangeAtPart;
const Rule toolChangeAtPart{.info = {"tool-change-at-part", Category::Motion, Severity::Warning,
                                     "Reports a `T` of a lathe that turns the turret while the tool is beside the part "
                                     "or right in front of it."},
                            .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::tool_change_at_part
