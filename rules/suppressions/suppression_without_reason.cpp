// suppression-without-reason: reported when suppressions are applied; the claim and its page live here.
#include "findings/rule/rule.h"

namespace feedhold::rules::suppression_without_reason {

extern const Rule suppressionWithoutReason;
const Rule suppressionWithoutReason{.info = {"suppression-without-reason", Category::Suppression, Severity::Warning,
                                             "Reports an `@ALLOW` without a reason after the rule."},
                                    .hooks = {}};

} // namespace feedhold::rules::suppression_without_reason
