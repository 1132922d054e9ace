#include "proof/families/call_inputs.h"

#include "meaning/cfg/program_nodes.h"
#include "meaning/cfg/reached_programs.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace feedhold::prove {

using smt::TermId;

namespace {

using Variables = std::set<std::uint32_t>;

/// Those that the program and what it calls read, and that their contracts name.  What is read by a computed number is
/// taken as any number, of which nothing is assumed.
Variables variablesOf(const ProofSubject &subject, const Callee &callee) {
  ReachedPrograms reached;
  collectReached(subject.programs, {callee.file, callee.program}, reached);
  Variables used;
  for (const ProgramRef &each : reached.programs) {
    const ProgramFile &file = subject.programs.file(each.file);
    for (const VariableUse &use : file.model->variablesOf(each.program)) {
      if (use.write)
        continue;
      if (const auto variable = variableOf(subject.programs, each.file, use))
        used.insert(*variable);
    }
    if (const FileContracts *contracts = subject.contractsOf({each.file, file.cfg.entryOf(each.program), each.program}))
      used.merge(variablesIn(*contracts));
    for (const Call &call :
         file.model->callsOf(each.program)) // a contract that stands for a missing program is read, too
      if (const auto missing = subject.options.missingContracts.find(call.callee.number.value_or(0));
          missing != subject.options.missingContracts.end())
        used.merge(variablesIn(*missing->second));
  }
  return used;
}

std::optional<std::string> brokenByNumber(const RunResult &run, const GivenVariables &) {
  if (run.end == RunEnd::Fuel || run.end == RunEnd::Repeats || run.end == RunEnd::Unmodelled)
    return std::nullopt;
  return "the call passes a number that nobody can type";
}

/// As shops type them; larger ones show nothing that a machinist would change.
constexpr double kLargestOrdinary = 100'000;

bool isOrdinary(const GivenVariables &given) {
  return std::ranges::all_of(given.entries(),
                             [](const auto &each) { return std::abs(each.second.number) <= kLargestOrdinary; });
}

std::optional<std::string> brokenByOrdinaryNumbers(const RunResult &run, const GivenVariables &given) {
  return isOrdinary(given) ? brokenByNumber(run, given) : std::nullopt;
}

class InputQuestions {
public:
  explicit InputQuestions(const ExploredProgram &program)
      : subject_(program.subject), start_(program.start), found_(program.found), store_(start_.store()),
        known_(start_.interpretation().facts().begin(), start_.interpretation().facts().end()) {}

  Questions take() {
    for (const CallInstance &call : found_.calls)
      ask(call);
    if (found_.incomplete && hasContract())
      askOfTheText();
    Questions questions;
    for (auto &[key, question] : asked_) {
      question.isToldByRuns = !hasContract();
      questions.push_back(std::move(question));
    }
    return questions;
  }

private:
  /// Without one nothing bounds the inputs of the program itself, and sums of the largest have too many digits: that
  /// what it passes can be typed is assumed then, and only a run on ordinary numbers that breaks it is told.
  bool hasContract() const { return subject_.contract() != nullptr; }

  void ask(const CallInstance &call) {
    SymbolicInterpretation &interpretation = start_.interpretation();
    const Dialect &dialect = *subject_.programs.file(call.callee.file).dialect;
    interpretation.useDialect(dialect);
    const FileContracts *contracts = subject_.contractsOf(call.callee);
    std::map<std::uint32_t, WrittenInput> written;
    if (contracts)
      written = writtenInputs(*contracts, *contracts->of(call.callee.program));
    for (const std::uint32_t variable : usedBy(call.callee)) {
      const TermId number = heldBy(interpretation, dialect, variable, call.state).number;
      std::vector<TermId> typed = interpretation.typedInput(variable, written[cellOf(dialect, variable)], number);
      if (!hasContract())
        std::erase_if(typed, [&](TermId each) { return store_[each].kind == smt::TermKind::Or; }); // not too small
      std::erase_if(typed, [&](TermId each) { return each == store_.yes() || known_.contains(each); });
      if (!typed.empty())
        questionOf(call.own, call.callee)
            .goals.push_back({&call.conditions, store_.logicalAnd(typed), {}, textOf(variable, number)});
    }
  }

  /// Where paths are missing: the calls in the text whose arguments are computed.
  void askOfTheText() {
    const ProgramModel &model = *subject_.file().model;
    for (std::size_t i = 0; i < model.calls.size(); ++i) {
      const Call &call = model.calls[CallId(i)];
      const auto callee = subject_.programs.callee(subject_.program.file, CallId(i));
      const bool computes = !call.values.empty() || std::ranges::any_of(call.arguments, [&](const Argument &argument) {
        return subject_.file().tree->words[argument.word].form() == WordForm::Expression;
      });
      if (callee && computes && call.caller == subject_.program.program)
        questionOf({subject_.program.file, subject_.file().cfg.nodeOf(call.block)}, *callee);
    }
  }

  const Variables &usedBy(const Callee &callee) {
    const auto [known, isNew] = used_.try_emplace({callee.file, callee.program});
    if (isNew)
      known->second = variablesOf(subject_, callee);
    return known->second;
  }

  Question &questionOf(Place own, const Callee &callee) {
    const auto key = std::pair(own, ProgramRef{callee.file, callee.program});
    const auto known = asked_.find(key);
    if (known != asked_.end())
      return known->second;
    return asked_
        .emplace(key,
                 Question{.row = subject_.obligation(ObligationKind::CallMeetsContract, own, subject_.spanOf(own),
                                                     fmt::format("this call passes numbers of at most 8 digits to {}",
                                                                 subject_.nameOf(callee))),
                          .goals = {},
                          .broken = hasContract() ? brokenByNumber : brokenByOrdinaryNumbers,
                          .isJudgedExactly = true})
        .first->second;
  }

  std::string textOf(std::uint32_t variable, TermId number) const {
    const std::string name = subject_.programs.nameOfVariable(variable);
    return store_.isNumber(number)
               ? fmt::format("{} is {:.17g} at the call, which nobody can type", name, store_[number].number.toDouble())
               : fmt::format("{} is a number that nobody can type", name);
  }

  const ProofSubject &subject_;
  ProofStart &start_;
  const Exploration &found_;
  smt::TermStore &store_;
  std::set<TermId> known_; // that are assumed of the inputs of the caller
  std::map<ProgramRef, Variables> used_;
  std::map<std::pair<Place, ProgramRef>, Question> asked_; // by block and callee
};

} // namespace

/// In exact arithmetic nothing is assumed of inputs.
Questions inputQuestions(const ExploredProgram &program) {
  if (program.subject.options.arithmetic == Arithmetic::Exact)
    return {};
  return InputQuestions(program).take();
}

} // namespace feedhold::prove
