// placeholder: a text that shows how a program looks.
#include "findings/rule/placeholders.h"
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::placeholder {
namespace {

void check(const FileContext &context, const Reporter &reporter) {
  if (const auto place = placeholderIn(context))
    reporter.report(
        {.message = fmt::format("this is not a complete program: {} stands for something else", context.quoted(*place)),
         .span = *place,
         .notes = {"no other rule looks at this file"}});
}

} // namespace

extern const Rule placeholder;
const Rule placeholder{
    .info = {"placeholder", Category::Comment, Severity::Info,
             "Reports a text that is no program yet, because it contains a placeholder such as `${..}` or `...`."},
    .hooks = {.file = check}};

} // namespace feedhold::rules::placeholder
