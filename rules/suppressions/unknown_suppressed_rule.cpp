// unknown-suppressed-rule: reported when suppressions are applied; the claim and its page live here.
#include "findings/rule/rule.h"

namespace feedhold::rules::unknown_suppressed_rule {

extern const Rule unknownSuppressedRule;
const Rule unknownSuppressedRule{.info = {"unknown-suppressed-rule", Category::Suppression, Severity::Error,
                                          "Reports an `@ALLOW` of a rule that does not exist."},
                                 .hooks = {}};

} // namespace feedhold::rules::unknown_suppressed_rule
