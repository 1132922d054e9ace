// foreign-language: reported by the session (other_language.h), of files that are refused and of those that it doubts;
// the claim and its page live here.
#include "findings/rule/rule.h"

namespace feedhold::rules::foreign_language {

extern const Rule foreignLanguage;
const Rule foreignLanguage{.info = {"foreign-language", Category::Syntax, Severity::Error,
                                    "Reports a file in a language that Feedhold does not read."},
                           .hooks = {}};

} // namespace feedhold::rules::foreign_language
