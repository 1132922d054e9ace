// zero-program-number: `O0000`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::zero_program_number {
namespace {

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  if (context.dialect.grammar.oWords || program.name.number != 0u)
    return;
  reporter.report(
      {.message = fmt::format("{} is not a number of a program; they begin at 1", context.quoted(program.header)),
       .span = program.header,
       .notes = {"the control asks for another number when the program is loaded, or refuses it",
                 "give the program a number of its own"}});
}

} // namespace

extern const Rule zeroProgramNumber;
const Rule zeroProgramNumber{
    .info = {"zero-program-number", Category::Structure, Severity::Info, "Reports a program with the number 0."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::zero_program_number
