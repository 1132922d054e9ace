// See the header.
#include "rules/flow/passed_values.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace feedhold::rules {
namespace {

// Each level is an analysis of all callers; macros in shops nest two or three deep.
constexpr std::size_t kMostCallers = 8;
constexpr int kMostLevels = 3;
constexpr std::size_t kMostNodesOfCaller = 20'000;

class PassedLookUp {
public:
  PassedLookUp(const ProgramSet &programs, const FileContext &context) : programs_(programs), context_(context) {}

  PassedValues look(std::uint32_t argument, ProgramRef program, int level) const {
    std::map<ProgramRef, std::vector<CallId>> callers;
    for (const CallGraph::Caller &caller : programs_.callGraph().callers(program))
      callers[{caller.file, programs_.file(caller.file).model->calls[caller.call].caller}].push_back(caller.call);
    if (callers.empty())
      return {PassedZero::NoCall};
    if (callers.size() > kMostCallers || level == kMostLevels || callers.contains(program))
      return {PassedZero::Unknown};
    PassedValues all{PassedZero::NoCall};
    for (const auto &[caller, calls] : callers) {
      const PassedValues here = byCaller(argument, caller, calls, level);
      if (here.zero == PassedZero::Maybe || here.zero == PassedZero::Unknown)
        return here;
      all = here.zero == PassedZero::Never ? here : all;
    }
    return all;
  }

private:
  PassedValues byCaller(std::uint32_t argument, ProgramRef caller, const std::vector<CallId> &calls, int level) const {
    if (programs_.file(caller.file).cfg.nodes.size() > kMostNodesOfCaller)
      return {PassedZero::Unknown};
    const FileContracts *contracts =
        caller.file.index() < context_.contracts.size() ? context_.contracts[caller.file.index()] : nullptr;
    const FlowFacts facts = collectFacts(programs_, caller.file, caller.program, {}, contracts);
    if (!facts.isComplete())
      return {PassedZero::Unknown};
    PassedValues all{PassedZero::NoCall};
    for (const CallFact &fact : facts.calls()) {
      if (std::ranges::find(calls, fact.call) == calls.end())
        continue;
      all.zero = PassedZero::Never;
      if (!fact.request.freshLocals || passesZero(argument, fact, facts, level)) {
        const Span place = facts.file.model->calls[fact.call].span;
        return {PassedZero::Maybe, Label{place, "this call may pass 0 or nothing", caller.file}};
      }
    }
    return all;
  }

  /// The expression of the word that passes the argument.
  static std::optional<ExpressionId> expressionOf(std::uint32_t argument, const CallFact &fact,
                                                  const FlowFacts &facts) {
    for (const Argument &each : facts.file.model->calls[fact.call].arguments) {
      const Word &word = facts.file.tree->words[each.word];
      if (each.variable == argument && each.role == ArgumentRole::Passed && word.form() == WordForm::Expression)
        return word.expression();
    }
    return std::nullopt;
  }

  bool passesZero(std::uint32_t argument, const CallFact &fact, const FlowFacts &facts, int level) const {
    const auto expression = expressionOf(argument, fact, facts);
    if (!expression)
      return mayBeZero(fact.request.locals[argument], facts, level);
    // A caller that asks for the value in some condition knows what it passes, as a program does that divides by it.
    const auto variable = variableOf(facts, *expression);
    if (variable && isTested(facts.file, facts.program, *variable))
      return false;
    // As it is written: the control may round what it passes, and a value that only so comes to 0 is no concern here.
    const AbstractValue *written = facts.valueOf(*expression);
    return mayBeZero(written ? *written : fact.request.locals[argument], facts, level);
  }

  bool mayBeZero(const AbstractValue &value, const FlowFacts &caller, int level) const {
    if (!value.mayBeVacant() && !value.number().contains(0))
      return false;
    const auto &origin = value.origin();
    if (!origin || !origin->offset.isZero() || !isEntrySymbol(origin->symbol) || !isLocal(caller.file, origin->symbol))
      return true;
    return look(origin->symbol, {caller.file.file, caller.program}, level + 1).zero != PassedZero::Never;
  }

  const ProgramSet &programs_;
  const FileContext &context_;
};

// Beyond it no test has set a bound.
constexpr double kAnyNumber = 1e6;

} // namespace

PassedValues passedFor(std::uint32_t argument, const FlowFacts &facts, const FileContext &context) {
  if (argument > kLocalVariables)
    return {PassedZero::Unknown};
  return PassedLookUp(facts.programs, context).look(argument, {facts.file.file, facts.program}, 0);
}

std::optional<std::uint32_t> checkedAboveOnly(const FlowFacts &facts, const FileContext &context, NodeId node,
                                              ExpressionId expression, const AbstractValue &value) {
  if (!value.mayBeNumber() || value.number().interval().hi > kAnyNumber || value.number().interval().lo > -kAnyNumber)
    return std::nullopt;
  const auto reads = readsIn(facts.file, expression, facts.node(node).block);
  const auto variable = reads.size() == 1 ? reads.front().number : std::nullopt;
  const auto argument = variable && isParameter(facts, *variable) ? argumentBehind(facts, *variable) : std::nullopt;
  const bool isOpen = argument && argument == variable && !isTestedForVacancy(facts.file, facts.program, *argument) &&
                      !isMainProgram(facts) && !mayHoldCallersValue(facts, *argument) &&
                      passedFor(*argument, facts, context).zero != PassedZero::Never;
  return isOpen ? argument : std::nullopt;
}

void addPassed(Diagnostic &diagnostic, const PassedValues &passed, const FlowFacts &facts) {
  if (passed.call)
    diagnostic.labels.push_back(*passed.call);
  if (passed.zero != PassedZero::NoCall)
    return;
  const ProgramName &name = facts.file.model->programs[facts.program].name;
  diagnostic.notes.push_back(fmt::format("no checked program calls {}: what its callers pass is not known",
                                         name.empty() ? "this one" : toString(name)));
}

} // namespace feedhold::rules
