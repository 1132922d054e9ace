// tool-change-at-part: `G01 Z-40.`, `G00 X82.`, `T0404`: the turret turns beside the part.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace feedhold::rules::tool_change_at_part {
namespace {

/// `T0404`, `T404`, `T4`: tool 4.  Absent for `T0400`, which may be a cancelled offset, and for what is computed.
std::optional<std::uint32_t> toolOf(const Word &word) {
  const auto number = word.integer();
  if (!number || word.has(Word::kArgument))
    return std::nullopt;
  return *number >= 100 ? *number / 100 : *number;
}

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

private:
  void noteReach(const std::optional<double> &x) {
    if (x)
      reach_ = std::max(reach_, std::abs(*x));
  }
  /// In front of the face by less than what tools differ in length.
  bool isNearFace(double z) const { return z <= (walk_.isMetric() ? 5 : 0.2); }

  void readTool(const Word &word, BlockId block, const Reporter &reporter) {
    const auto tool = toolOf(word);
    if (tool == 0U)
      return;
    const TurningPoint &at = walk_.at();
    const bool isOther = tool && tool_ && *tool != *tool_;
    const bool isAtPart = isOther && cut_ && at.x && at.z && std::abs(*at.x) <= reach_ && isNearFace(*at.z);
    const bool movesInBlock = findWord(context_.tree, block, 'X') || findWord(context_.tree, block, 'Z');
    if (isAtPart && !movesInBlock)
      tell(word, *at.x, *at.z, reporter);
    tool_ = tool;
    cut_ = nullptr;
  }

  void tell(const Word &word, double x, double z, const Reporter &reporter) const {
    const bool isBeside = z < 0;
    const bool isAtFace = !isBeside && z <= (walk_.isMetric() ? 0.5 : 0.02);
    reporter.report(
        {.message = fmt::format("{} turns the turret at X{:g} Z{:g}, {} the part", context_.quoted(word.span()), x, z,
                                isBeside   ? "beside"
                                : isAtFace ? "on the face of"
                                           : "right in front of"),
         .span = word.span(),
         .labels = {{cut_->span(), "the last cut"}},
         .notes = {isBeside ? "the tools that swing past hit the part or the chuck"
                            : "a tool that is longer than this one hits the face when it swings in",
                   "retract first, by `G28 U0 W0` or to a safe X and Z"}},
        isBeside || isAtFace ? Severity::Warning : Severity::Info);
  }

  const FileContext &context_;
  TurningWalk walk_;
  std::optional<std::uint32_t> tool_; // in the turret's working place
  const Block *cut_ = nullptr;        // the last one with it
  double reach_ = 0;                  // the largest X at which the program cuts
};

} // namespace

extern const Rule toolChangeAtPart;
const Rule toolChangeAtPart{.info = {"tool-change-at-part", Category::Motion, Severity::Warning,
                                     "Reports a `T` of a lathe that turns the turret while the tool is beside the part "
                                     "or right in front of it."},
                            .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::tool_change_at_part
