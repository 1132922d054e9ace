#include "golden/verdicts_stage.h"

#include "language/dialect/switch_names.h"
#include "surface/sink/prove_shown.h"

#include <fmt/format.h>

namespace feedhold::golden {

namespace {

std::string settingsOf(const prove::Witness &witness) {
  std::string text;
  for (const auto &[setting, isOn] : witness.variables.start.settings)
    text += fmt::format(", where {} is {}", switchNames()[setting].name, isOn ? "on" : "off");
  return text;
}

std::string detailOf(const prove::Verdict &verdict) {
  if (!verdict.bound().empty())
    return fmt::format("\n  at most `{}` iterations", verdict.bound());
  if (verdict == prove::Verdict::Unknown)
    return fmt::format("\n  {}", verdict.reason());
  return verdict.witness() ? fmt::format("\n  {}{}", verdict.witness()->happened, settingsOf(*verdict.witness())) : "";
}

std::string assumedBy(const prove::Obligation &row) {
  std::string text;
  for (const std::string &assumed : row.verdict.holds() ? assumedIn(row) : std::vector<std::string>())
    text += "\n  " + assumed;
  return text;
}

std::string rowsOf(const ProvedFile &file, const ProvedProgram &program) {
  std::string text;
  for (const prove::Obligation &row : program.proof.obligations)
    text += fmt::format("line {}: {}: {}: {}{}{}\n", file.file().source.lineOf(row.span.begin), nameOf(row.verdict),
                        nameOf(row.kind), row.claim, detailOf(row.verdict), assumedBy(row));
  return text;
}

} // namespace

std::string verdictsOf(const ProofsResult &result) {
  std::string text;
  for (const PathProblem &problem : result.errors)
    text += fmt::format("{}: {}\n", problem.path, problem.message);
  for (const ProvedFile &file : result.files)
    for (const ProvedProgram &program : file.programs)
      text += fmt::format("{}\n{}", toString(file.file().model.programs[program.program].name), rowsOf(file, program));
  return text;
}

} // namespace feedhold::golden
