// compensation-without-number: G41 before any D.
#include "rules/motion/number_left_out.h"

namespace feedhold::rules::compensation_without_number {
namespace {

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return watchForMissingNumber(
      {{CodeAction::CompensationLeft, CodeAction::CompensationRight}, 'D', "the cutter radius"}, program, context);
}

} // namespace

extern const Rule compensationWithoutNumber;
const Rule compensationWithoutNumber{.info = {"compensation-without-number", Category::Motion, Severity::Warning,
                                              "Reports a `G41` or `G42` in a main program before any `D`."},
                                     .hooks = {.watch = watch}};

} // namespace feedhold::rules::compensation_without_number
