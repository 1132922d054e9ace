// call-outside-contract: a literal argument that the contract of the macro does not allow, or a required one not
// passed.
#include "rules/contract/contract_view.h"

#include "language/contract/constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace feedhold::rules::call_outside_contract {
namespace {

/// What a call passes in one variable, when that can be told.
struct Passed {
  Span span;
  std::vector<Rational> values; // the possible ones; empty: not known here
};

/// A literal without a point counts in mm or in increments; which of them a machine parameter decides.
std::vector<Rational> valuesOf(const Word &word, const FileContext &context) {
  if (word.form() == WordForm::Expression) {
    const auto value = constantValue(context.tree, word.expression());
    return value ? std::vector{*value} : std::vector<Rational>();
  }
  const auto value = word.isNumber() ? Rational::fromDecimal(word.number()) : std::nullopt;
  if (!value)
    return {};
  const AddressKind kind = formatOf(context.dialect, word.address()).kind;
  const bool isScaled = kind == AddressKind::Length || kind == AddressKind::Angle || kind == AddressKind::Rate ||
                        kind == AddressKind::Flexible;
  if (word.has(Word::kPoint) || value->isZero() || !isScaled || context.dialect.switches.dpi == Switch::On)
    return {*value};
  std::vector<Rational> values{*value};
  const LeastIncrements increments = leastIncrementsOf(context.dialect);
  for (const Decimal &increment : {increments.metric, increments.inch})
    if (const auto step = Rational::fromDecimal(increment))
      if (const auto scaled = multiply(*value, *step))
        values.push_back(*scaled);
  return values;
}

std::map<std::uint32_t, Passed> passedBy(const Call &call, const FileContext &context) {
  std::map<std::uint32_t, Passed> passed;
  for (const Argument &argument : call.arguments)
    if (argument.role == ArgumentRole::Passed && argument.variable != 0) {
      const Word &word = context.tree.words[argument.word];
      passed.insert_or_assign(argument.variable, Passed{word.span(), valuesOf(word, context)});
    }
  for (std::size_t i = 0; i < call.values.size(); ++i) {
    const auto value = constantValue(context.tree, call.values[i]);
    passed.insert_or_assign(
        static_cast<std::uint32_t>(i + 1),
        Passed{context.tree.expressions[call.values[i]].span, value ? std::vector{*value} : std::vector<Rational>()});
  }
  return passed;
}

class CallCheck {
public:
  CallCheck(const Call &call, ProgramRef callee, const FileContext &context, const Reporter &reporter)
      : call_(call), callee_(callee), context_(context), reporter_(reporter),
        contracts_(*context.contracts[callee.file.index()]), passed_(passedBy(call, context)) {}

  void run(const Contract &contract) {
    for (const EntryValue &param : contract.params)
      checkParam(param);
    if (reported_)
      return;
    for (const ContractCondition &requirement : contract.requirements)
      if (constantTruth(contracts_.tree, requirement.condition, valueOf_) == false)
        report(fmt::format("this call does not meet a requirement of {}", name()), call_.span, requirement.clause);
  }

private:
  std::string name() const { return toString(context_.callGraph.model(callee_.file).programs[callee_.program].name); }

  void checkParam(const EntryValue &param) {
    const std::string shown = param.name.empty() ? fmt::format("`#{}`", param.variable)
                                                 : fmt::format("`#{}` ({})", param.variable, param.name);
    const auto found = passed_.find(param.variable);
    const bool mayMiss = call_.kind == CallKind::OWord && !context_.dialect.behaviour.variablesMayBeVacant;
    if (found == passed_.end()) {
      if (param.vacancy == Vacancy::Never && !mayMiss)
        report(fmt::format("{} needs {}, but this call does not pass it", name(), shown), call_.span, param.clause);
      return;
    }
    const std::vector<Rational> &values = found->second.values;
    if (!values.empty() && std::ranges::none_of(values, [&](const Rational &value) { return mayBe(param, value); }))
      report(fmt::format("{} does not allow {} for {}", name(), context_.quoted(found->second.span), shown),
             found->second.span, param.clause);
  }

  /// The contract may allow the value.
  bool mayBe(const EntryValue &param, const Rational &value) const {
    if (param.unit == Unit::Integer && !value.isInteger())
      return false;
    if (const auto step = param.step ? Rational::fromDecimal(*param.step) : std::nullopt)
      if (const auto steps = divide(value, *step); steps && !steps->isInteger())
        return false;
    if (const auto *range = std::get_if<Range>(&param.values)) {
      const auto low = range->low ? constantValue(contracts_.tree, *range->low, valueOf_) : std::nullopt;
      const auto high = range->high ? constantValue(contracts_.tree, *range->high, valueOf_) : std::nullopt;
      return (!low || *low <= value) && (!high || value <= *high);
    }
    const auto *list = std::get_if<ValueList>(&param.values);
    return !list || std::ranges::any_of(list->values, [&](ExpressionId id) {
      const auto allowed = constantValue(contracts_.tree, id, valueOf_);
      return !allowed || *allowed == value;
    });
  }

  void report(std::string message, Span span, ClauseId id) {
    reported_ = true;
    Diagnostic diagnostic{.message = std::move(message), .span = span};
    pointAtContract(id, callee_.file, context_, diagnostic);
    reporter_.report(std::move(diagnostic));
  }

  const Call &call_;
  ProgramRef callee_;
  const FileContext &context_;
  const Reporter &reporter_;
  const FileContracts &contracts_;
  std::map<std::uint32_t, Passed> passed_;
  bool reported_ = false;
  ValueOfVariable valueOf_ = [this](std::uint32_t variable) -> std::optional<Rational> {
    const auto found = passed_.find(variable);
    const bool isKnown = found != passed_.end() && found->second.values.size() == 1;
    return isKnown ? std::optional(found->second.values.front()) : std::nullopt;
  };
};

/// A call that passes arguments in local variables of its own.
bool passesArguments(const Call &call) {
  switch (call.kind) {
  case CallKind::Macro:
  case CallKind::Modal:
  case CallKind::ModalEach:
  case CallKind::OWord: return true;
  case CallKind::Code: // a subprogram, or a macro: the machine's tables say
  case CallKind::ModalCancel:
  case CallKind::MacroA:
  case CallKind::Subprogram:
  case CallKind::Local:
  case CallKind::External: return false;
  }
  return false;
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const auto callee = passesArguments(call) ? context.callGraph.callee(context.file, call) : std::nullopt;
  if (const Contract *contract = callee ? context.contractOf(*callee) : nullptr)
    CallCheck(call, *callee, context, reporter).run(*contract);
}

} // namespace

extern const Rule callOutsideContract;
const Rule callOutsideContract{.info = {"call-outside-contract", Category::Contract, Severity::Error,
                                        "Reports a call that the contract of the macro does not allow."},
                               .hooks = {.call = check}};

} // namespace feedhold::rules::call_outside_contract
