// encrypted-program: `G10L60P1[*..*]`: nothing is known of what the program does.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::encrypted_program {
namespace {

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  if (!program.isEncrypted)
    return;
  const std::string name = program.name.empty() ? "this program" : fmt::format("`{}`", toString(program.name));
  reporter.report(
      {.message = fmt::format("{} is encrypted and is not checked", name),
       .span = program.header,
       .notes = {"what it does is not known: after a call of it, every variable and modal code may differ"}});
}

} // namespace

extern const Rule encryptedProgram;
const Rule encryptedProgram{
    .info = {"encrypted-program", Category::Structure, Severity::Info, "Reports a program whose text is encrypted."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::encrypted_program
