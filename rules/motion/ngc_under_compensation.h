// code-under-compensation, as LinuxCNC stops: other codes than on other controls, and reads of `#5420`.
#pragma once

#include "findings/rule/rule.h"

#include <memory>

namespace feedhold::rules::code_under_compensation {

std::unique_ptr<FlowRule> watchNgc(ProgramId program, const FileContext &context);

} // namespace feedhold::rules::code_under_compensation
