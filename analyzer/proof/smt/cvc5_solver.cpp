// cvc5, as a program: its Debian build is GPL and is never linked.
#include "base/support/process.h"
#include "proof/smt/solver.h"

namespace feedhold::smt {
namespace {

constexpr ProcessLimits kLimits{.processorSeconds = 6, .watchdogSeconds = 60};

// Measured: tangent planes between the other lemmas decide more, and sooner, than the default does.
const std::vector<std::string> kTangentPlanes{"--nl-ext=full", "--nl-ext-tplanes-interleave"};

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

/// Each question is a run of its own: a `(reset)` forgets the one before.
ProcessLimits limitsFor(std::size_t questions) {
  const auto count = static_cast<std::uint32_t>(questions);
  return {kLimits.processorSeconds + count, kLimits.watchdogSeconds + 2 * count};
}

/// A line for each answer; fewer than questions when the program stops at one.
Result<std::vector<Answer>> askTogether(std::span<const std::string> texts, std::uint64_t resources) {
  std::vector<std::string> command{"cvc5", "--lang=smt2", "--rlimit-per=" + std::to_string(resources)};
  command.insert(command.end(), kTangentPlanes.begin(), kTangentPlanes.end());
  std::string input;
  for (const std::string &text : texts)
    input += text + "\n(reset)\n";
  const Result<ProcessOutput> output = runProgram(command, input, limitsFor(texts.size()));
  if (!output)
    return output.error();
  std::vector<Answer> answers;
  std::string_view rest = output.value().output;
  for (std::size_t end = rest.find('\n'); end != std::string_view::npos && answers.size() < texts.size();
       end = rest.find('\n')) {
    const std::string_view line = rest.substr(0, end);
    if (line == "unsat")
      answers.push_back({Unsat{}, resources});
    else if (line == "sat")
      answers.push_back({Sat{}, resources});
    else if (line == "unknown")
      answers.push_back({NoAnswer{"cvc5 gave no answer"}, resources});
    else
      break; // a problem, after which it stops
    rest.remove_prefix(end + 1);
  }
  return answers;
}

} // namespace

Answer askCvc5(const std::string &smtlib, std::uint64_t resources) {
  if (!smtlib.starts_with("(set-logic QF_N"))
    return ask(smtlib, resources, {});
  Answer first = ask(smtlib, resources, kTangentPlanes);
  if (!std::holds_alternative<NoAnswer>(first.result))
    return first;
  Answer second = ask(smtlib, resources, {});
  second.effort += first.effort;
  return second;
}

std::vector<Answer> askCvc5InTurn(std::span<const std::string> texts, std::uint64_t resources) {
  std::vector<Answer> answers;
  while (answers.size() < texts.size()) {
    const Result<std::vector<Answer>> some = askTogether(texts.subspan(answers.size()), resources);
    if (!some) {
      answers.resize(texts.size(), Answer{NoAnswer{some.error().message}});
      break;
    }
    answers.insert(answers.end(), some.value().begin(), some.value().end());
    if (answers.size() < texts.size())
      answers.push_back({NoAnswer{"cvc5 stopped at this question"}, resources});
  }
  return answers;
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
