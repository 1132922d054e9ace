// roughing-start-in-stock: `G71` from X5 of a contour that goes out to X27.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::roughing_start_in_stock {
namespace {

/// mm or inch: less is an allowance.
constexpr double kClearly = 0.05;

class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), walk_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    const TurningPoint start = walk_.at();
    walk_.read(block);
    for (const Contour &contour : walk_.contours())
      if (contour.cycle->block == block && contour.standsBehindCycle() && start.x)
        readRoughing(contour, start, reporter);
  }

private:
  void readRoughing(const Contour &contour, const TurningPoint &start, const Reporter &reporter) const {
    const Word *code = findCode(context_.tree, contour.cycle->block, context_.dialect, CodeRole::Contour);
    const Code *row = code ? codeOf(*code, context_.dialect) : nullptr;
    const Word *allowance = findWord(context_.tree, contour.cycle->block, 'U');
    if (!row || row->action != CodeAction::TurnContour || !allowance || !allowance->isNumber() ||
        allowance->number().isZero())
      return;
    std::vector<TurningPoint> corners = walk_.cornersOf(contour, start);
    if (corners.size() < 3)
      return;
    corners.pop_back(); // the way out of the contour may lead past the stock
    const auto [least, most] = std::ranges::minmax(corners, {}, [](const TurningPoint &corner) { return *corner.x; });
    const bool isOutside = allowance->number().toDouble() > 0;
    const double beyond = isOutside ? *most.x - *start.x : *start.x - *least.x;
    // A contour that lies beyond the start as a whole is machined from the other side.
    const bool isBeside = isOutside ? *least.x >= *start.x : *most.x <= *start.x;
    if (beyond > kClearly && !isBeside)
      tell(*code, start, isOutside ? most : least, isOutside, reporter);
    else if (beyond > kClearly && !isOutside && isOfBore(corners))
      tellOutsideBore(*code, start, most, reporter);
  }

  void tellOutsideBore(const Word &code, const TurningPoint &start, const TurningPoint &widest,
                       const Reporter &reporter) const {
    reporter.report({.message = fmt::format("{} starts at X{:g}, outside of the bore, whose widest diameter is X{:g}",
                                            context_.quoted(code.span()), *start.x, *widest.x),
                     .span = code.span(),
                     .notes = {"the cycle cuts towards its contour: from there it goes into the face of the part",
                               "start the cycle at the diameter of the hole, or inside it"}});
  }

  void tell(const Word &code, const TurningPoint &start, const TurningPoint &corner, bool isOutside,
            const Reporter &reporter) const {
    reporter.report(
        {.message = fmt::format("{} starts at X{:g}, and its contour goes {} to X{:g}", context_.quoted(code.span()),
                                *start.x, isOutside ? "out" : "in", *corner.x),
         .span = code.span(),
         .notes = {fmt::format("what lies {} X{:g} is not roughed: the last pass along the contour takes it in one cut",
                               isOutside ? "outside" : "inside", *start.x),
                   isOutside ? "start the cycle at the diameter of the stock, or outside it"
                             : "start the cycle at the diameter of the hole, or inside it"}});
  }

  const FileContext &context_;
  TurningWalk walk_;
};

} // namespace

extern const Rule roughingStartInStock;
const Rule roughingStartInStock{
    .info = {"roughing-start-in-stock", Category::Motion, Severity::Warning,
             "Reports a roughing cycle of a lathe that starts inside the diameters to which its contour goes out, or "
             "outside of the bore."},
    .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::roughing_start_in_stock
