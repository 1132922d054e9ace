// length-offset-without-number: G43 before any H.
#include "rules/motion/number_left_out.h"

namespace feedhold::rules::length_offset_without_number {
namespace {

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return watchForMissingNumber({{CodeAction::LengthPlus, CodeAction::LengthMinus}, 'H', "the length offset"}, program,
                               context);
}

} // namespace

extern const Rule lengthOffsetWithoutNumber;
const Rule lengthOffsetWithoutNumber{.info = {"length-offset-without-number", Category::Motion, Severity::Warning,
                                              "Reports a `G43` or `G44` in a main program before any `H`."},
                                     .hooks = {.watch = watch}};

} // namespace feedhold::rules::length_offset_without_number
