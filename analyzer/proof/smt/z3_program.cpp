// Z3, as a program on the PATH: for builds that link no solver.  Takes the place of z3_solver.cpp.
#include "base/support/process.h"
#include "proof/smt/s_expression.h"
#include "proof/smt/solver.h"

namespace feedhold::smt {
namespace {

/// As z3_solver.cpp has them: against a Z3 that ignores its budget.
ProcessLimits limitsOfProgram(std::uint64_t resources) {
  return {.processorSeconds = 2 + static_cast<std::uint32_t>(15 * resources / 1'000'000), .watchdogSeconds = 120};
}

constexpr std::uint64_t kMostResources = 4'294'967'295; // what its parameter can hold

/// Behind the question: what it took, and the model twice, because only decimals show irrational numbers.
constexpr std::string_view kAfterwards =
    "(get-info :rlimit)\n(get-model)\n(set-option :pp.decimal true)\n(get-model)\n";

/// `3.0`, `(- 3.0)`, `(/ 1.0 3.0)`; `1.41421?` is cut off.  Absent for `(root-obj ..)`.
std::optional<Number> numberIn(const SExpression &value) {
  if (value.isAtom()) {
    const std::string_view digits = value.atom;
    return Number::parse(digits.substr(0, digits.find('?')));
  }
  if (value.isCall("-") && value.items.size() == 2)
    if (const std::optional<Number> inner = numberIn(value.items[1]))
      return -*inner;
  if (value.isCall("/") && value.items.size() == 3) {
    const std::optional<Number> above = numberIn(value.items[1]);
    const std::optional<Number> below = numberIn(value.items[2]);
    if (above && below && below->sign() != 0)
      return *above / *below;
  }
  return std::nullopt;
}

/// `((define-fun x () Real 3.0) ..)`; functions with arguments, and values that cannot be read, are left out.
void addValues(Sat &sat, const SExpression &model) {
  for (const SExpression &definition : model.items) {
    if (!definition.isCall("define-fun") || definition.items.size() != 5 || !definition.items[2].items.empty())
      continue;
    const std::string &name = definition.items[1].atom;
    const SExpression &value = definition.items[4];
    if (value.isAtom("true") || value.isAtom("false"))
      sat.model.emplace(name, value.isAtom("true"));
    else if (const std::optional<Number> number = numberIn(value))
      sat.model.emplace(name, *number);
  }
}

/// `sat (:rlimit 12) MODEL MODEL`, `unsat (:rlimit 12) (error ..)`
Answer answerIn(const std::string &output) {
  const Result<std::vector<SExpression>> read = readSExpressions(output);
  if (!read || read.value().size() < 2 || !read.value()[1].isCall(":rlimit") || read.value()[1].items.size() != 2)
    return {NoAnswer{"Z3 gave no answer"}};
  const std::vector<SExpression> &items = read.value();
  Answer answer{NoAnswer{"Z3 gave no answer"}, 0};
  if (const std::optional<Number> effort = Number::parse(items[1].items[1].atom))
    answer.effort = static_cast<std::uint64_t>(effort->toDouble());
  if (items[0].isAtom("unsat"))
    answer.result = Unsat{};
  if (items[0].isAtom("sat")) {
    Sat sat;
    for (std::size_t index = 2; index < items.size(); ++index)
      addValues(sat, items[index]);
    answer.result = std::move(sat);
  }
  return answer;
}

std::optional<std::string> askedVersion() {
  const Result<ProcessOutput> output = runProgram({"z3", "--version"}, "", limitsOfProgram(0));
  if (!output || output.value().end == ProcessOutput::End::Killed || output.value().exitCode != 0)
    return std::nullopt;
  constexpr std::string_view kBegin = "Z3 version ";
  const std::string_view text = output.value().output;
  if (!text.starts_with(kBegin))
    return std::nullopt;
  return "z3 " + std::string(text.substr(kBegin.size(), text.find_first_of(" \n", kBegin.size()) - kBegin.size()));
}

} // namespace

Answer askZ3(const std::string &smtlib, Arithmetic, std::uint64_t resources) {
  if (!z3Version())
    return {NoAnswer{"Z3 is not installed"}};
  const std::uint64_t most = resources < kMostResources ? resources : kMostResources;
  const Result<ProcessOutput> output =
      runProgram({"z3", "-in", "-smt2", "rlimit=" + std::to_string(most), "memory_max_size=800"},
                 smtlib + std::string(kAfterwards), limitsOfProgram(resources));
  if (!output)
    return {NoAnswer{output.error().message}};
  if (output.value().end == ProcessOutput::End::Killed)
    return {NoAnswer{"Z3 did not obey its budget and was stopped"}, resources}; // as z3_solver.cpp has it
  return answerIn(output.value().output);
}

std::optional<std::string> z3Version() {
  static const std::optional<std::string> version = askedVersion();
  return version;
}

} // namespace feedhold::smt
