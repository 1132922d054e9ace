// unused-suppression: reported when suppressions are applied; the claim and its page live here.
#include "findings/rule/rule.h"

namespace feedhold::rules::unused_suppression {

extern const Rule unusedSuppression;
const Rule unusedSuppression{.info = {"unused-suppression", Category::Suppression, Severity::Warning,
                                      "Reports an `@ALLOW` that suppresses nothing."},
                             .hooks = {}};

} // namespace feedhold::rules::unused_suppression
