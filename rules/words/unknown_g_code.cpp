// unknown-g-code: `G777`.
#include "rules/words/lone_number.h"

#include <fmt/format.h>

namespace feedhold::rules::unknown_g_code {
namespace {

void check(const Word &word, BlockId, const FileContext &context, const Reporter &reporter) {
  if (!word.isNumber() || loneNumberIn(word, context))
    return;
  const auto tenths = word.tenths();
  if (tenths && hasGCode(context.dialect, *tenths))
    return;
  reporter.report(
      {.message = fmt::format("{} does not have {}", context.dialect.id, context.quoted(word.span())),
       .span = word.span(),
       .notes = {
           fmt::format("the control {}, unless {} makes the code a call",
                       stopsWith(context.dialect, AlarmKind::GCodeNotUsable),
                       context.dialect.grammar.oWords ? "a `REMAP=` of the .ini file" : "a parameter"),
           "if the code calls a program, list it under `[[code-calls]]` in feedhold.toml; if the machine's builder "
           "has defined it, under `builders-codes`"}});
}

} // namespace

extern const Rule unknownGCode;
const Rule unknownGCode{
    .info = {"unknown-g-code",
             Category::Word,
             Severity::Info,
             "Reports a G code that the control does not have and that `feedhold.toml` does not list.",
             {},
             CauseScope::OneFolder},
    .hooks = {.word = check, .wordAddresses = "G"}};

} // namespace feedhold::rules::unknown_g_code
