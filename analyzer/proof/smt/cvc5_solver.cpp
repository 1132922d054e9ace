// cvc5, as a program: its Debian build is GPL and is never linked.
#include "base/support/process.h"
#include "proof/smt/solver.h"

namespace feedhold::smt {
namespace {

constexpr ProcessLimits kLimits{.processorSeconds = 6, .watchdogSeconds = 60};

Answer ask(const std::string &smtlib, std::uint64_t resources, const std::vector<std::string> &options) {
  std::vector<std::string> command{"cvc5", "--lang=smt2", "--rlimit=" + std::to_string(resources)};
  command.insert(command.end(), options.begin(), options.end());
  Result<ProcessOutput> output = runProgram(command, smtlib, kLimits);
  if (!output)
    return {NoAnswer{output.error().message}};
  if (output.value().end == ProcessOutput::End::Killed)
    return {NoAnswer{"cvc5 did not obey its budget and was stopped"}, resources};
  const std::string &text = output.value().output;
  // A run that reports a problem has no answer, whatever else it prints.
  if (output.value().exitCode == 0 && text == "unsat\n")
    return {Unsat{}, resources};
  if (output.value().exitCode == 0 && text == "sat\n")
    return {Sat{}, resources};
  return {NoAnswer{"cvc5 gave no answer"}, resources};
}

} // namespace

Answer askCvc5(const std::string &smtlib, std::uint64_t resources) {
  if (!smtlib.starts_with("(set-logic QF_N"))
    return ask(smtlib, resources, {});
  // Measured: tangent planes between the other lemmas decide more, and sooner, than the default does.
  Answer first = ask(smtlib, resources, {"--nl-ext=full", "--nl-ext-tplanes-interleave"});
  if (!std::holds_alternative<NoAnswer>(first.result))
    return first;
  Answer second = ask(smtlib, resources, {});
  second.effort += first.effort;
  return second;
}

std::optional<std::string> cvc5Version() {
  Result<ProcessOutput> output = runProgram({"cvc5", "--version"}, "", kLimits);
  if (!output || output.value().end == ProcessOutput::End::Killed || output.value().exitCode != 0)
    return std::nullopt;
  const std::string &text = output.value().output;
  const std::size_t version = text.find("version ");
  return version == std::string::npos
             ? std::nullopt
             : std::optional("cvc5 " + text.substr(version + 8, text.find_first_of(" \n", version + 8) - version - 8));
}

} // namespace feedhold::smt
