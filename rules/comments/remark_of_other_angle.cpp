// remark-of-other-angle: `G01 U0.1 W-0.1 (1/32X45 CHAMFER)` on a lathe, where U counts in diameters.
#include "rules/comments/remarks_of_block.h"
#include "rules/motion/straight_cuts.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <optional>
#include <string>

namespace feedhold::rules::remark_of_other_angle {
namespace {

/// Degrees: ends of a chamfer are rounded, and a shop says 15 degrees of 14.
constexpr double kSame = 3;
/// How many blocks below it a remark on a line of its own is about.
constexpr int kReach = 6;

/// In the languages of the shops.
bool speaksOfSlope(std::string_view remark) {
  return saysAny(remark,
                 {"CHAMF", "CHANF", "CHAFL", "CONE", "TAPER", "BEVEL", "FASE", "FASKA", "FASCA", "KEGEL", "SMUSS"});
}

/// `1.5X45`, `20DEG`, `30\xC2\xB0`: in degrees.
std::optional<double> angleIn(std::string_view remark) {
  constexpr double kMost = 80;
  for (std::size_t at = 0; at < remark.size(); ++at) {
    if (!isDigit(remark[at]) || (at > 0 && (isDigit(remark[at - 1]) || remark[at - 1] == '.')))
      continue;
    std::size_t end = remark.find_first_not_of("0123456789.", at);
    end = std::min(end, remark.size());
    const double angle = std::strtod(std::string(remark.substr(at, end - at)).c_str(), nullptr);
    const std::string_view behind = trimmed(remark.substr(end));
    const std::string_view before = trimmed(remark.substr(0, at));
    const bool isInDegrees = behind.starts_with("DEG") || behind.starts_with("\xC2\xB0");
    const bool isBehindSize = before.ends_with('X') && angle == 45 && end - at == 2;
    if ((isInDegrees || isBehindSize) && angle > 0 && angle < kMost)
      return angle;
  }
  return std::nullopt;
}

std::optional<double> slopeIn(const Comment &comment, const FileContext &context) {
  const std::string remark = toUpper(context.text(comment.span));
  return speaksOfSlope(remark) ? angleIn(remark) : std::nullopt;
}

/// A straight cut in X and in Z.
struct Cut {
  double across; // in radius
  double along;
};
using Cuts = std::map<BlockId, Cut>;

Cuts slantedCutsOf(ProgramId program, const FileContext &context) {
  Cuts cuts;
  for (const auto &[block, cut] : straightCutsOf(program, context)) {
    const double across = std::abs(*cut.to.x - *cut.from.x) / 2;
    const double along = std::abs(*cut.to.z - *cut.from.z);
    if (across > 0 && along > 0)
      cuts.emplace(block, Cut{across, along});
  }
  return cuts;
}

double degreesOf(const Cut &cut) { return std::atan2(cut.across, cut.along) * 180 / std::numbers::pi; }

/// To the axis or to the face; of a cone, the whole angle or half of it.
bool fits(const Cut &cut, double angle) {
  const double actual = degreesOf(cut);
  for (const double said : {angle, angle / 2})
    if (std::abs(actual - said) < kSame || std::abs(90 - actual - said) < kSame)
      return true;
  return false;
}

/// The first slanted cut below a remark on a line of its own, above the next such remark.
std::optional<BlockId> cutBelow(BlockId remark, BlockId last, const Cuts &cuts, const FileContext &context) {
  int count = 0;
  for (BlockId block = remark.next(); block < last && count < kReach; block = block.next()) {
    if (cuts.contains(block))
      return block;
    if (!context.tree.commentsOf(block).empty() || findWord(context.tree, block, 'T'))
      return std::nullopt;
    count += isEmpty(context.tree, block) ? 0 : 1;
  }
  return std::nullopt;
}

void tell(BlockId block, const Cut &cut, double angle, const Comment &comment, const FileContext &context,
          const Reporter &reporter) {
  const auto words = context.tree.wordsOf(block);
  const double across = 2 * cut.along * std::tan(angle * std::numbers::pi / 180);
  reporter.report(
      {.message =
           fmt::format("the cut is at {:.1f} degrees to the axis, and its remark says {:g}", degreesOf(cut), angle),
       .span = {words.front().span().begin, words.back().span().end},
       .labels = {{comment.span, "the remark"}},
       .notes = {fmt::format("it goes {:.4g} in radius and {:.4g} along Z: X and U count in diameters", cut.across,
                             cut.along),
                 fmt::format("for {:g} degrees over {:.4g} along Z, X changes by {:.4g}", angle, cut.along, across)}});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  const Program &its = context.model.programs[program];
  const Cuts cuts = slantedCutsOf(program, context);
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    const auto comments = context.tree.commentsOf(block);
    const auto angle = comments.size() == 1 ? slopeIn(comments.front(), context) : std::nullopt;
    if (!angle)
      continue;
    const bool isOwnLine = isEmpty(context.tree, block);
    const auto at = isOwnLine ? cutBelow(block, its.last, cuts, context) : std::optional(block);
    const auto cut = at ? cuts.find(*at) : cuts.end();
    if (cut != cuts.end() && !fits(cut->second, *angle))
      tell(cut->first, cut->second, *angle, comments.front(), context, reporter);
  }
}

} // namespace

extern const Rule remarkOfOtherAngle;
const Rule remarkOfOtherAngle{.info = {"remark-of-other-angle", Category::Comment, Severity::Warning,
                                       "Reports a chamfer or a cone of a lathe whose angle differs from that in its "
                                       "remark."},
                              .hooks = {.program = check}};

} // namespace feedhold::rules::remark_of_other_angle
