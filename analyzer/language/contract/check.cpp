// What can only be seen when all clauses of a contract are read: empty ranges, units, variables that the program does
// not use, regions without a tool.
#include "language/contract/clauses.h"
#include "language/contract/constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold {

namespace {

void checkRanges(ContractReading &reading) {
  const SyntaxTree &tree = reading.result.tree;
  for (const ReadRange &read : reading.ranges) {
    const Clause &clause = reading.result.clauses[read.clause];
    const auto low = read.range.low ? constantValue(tree, *read.range.low) : std::nullopt;
    const auto high = read.range.high ? constantValue(tree, *read.range.high) : std::nullopt;
    if (!low || !high || *low <= *high)
      continue;
    const std::string_view text = reading.result.source(clause.source).text();
    const auto written = [&](ExpressionId id) {
      const Span span = tree.expressions[id].span;
      return text.substr(span.begin, span.size());
    };
    addIssue(reading, {ContractIssueKind::EmptyRange, clause.source, read.span,
                       fmt::format("{} is above {}", written(*read.range.low), written(*read.range.high)), std::nullopt,
                       clause.program});
    contractOf(reading, clause.program).isSound = false;
  }
}

enum class LengthSystem { None, Metric, Inch };

LengthSystem systemOf(Unit unit) {
  switch (unit) {
  case Unit::Millimetre:
  case Unit::MillimetrePerMinute:
  case Unit::MillimetrePerRevolution: return LengthSystem::Metric;
  case Unit::Inch:
  case Unit::InchPerMinute:
  case Unit::InchPerRevolution: return LengthSystem::Inch;
  case Unit::None:
  case Unit::Degree:
  case Unit::Revolution:
  case Unit::Second:
  case Unit::RevolutionPerMinute:
  case Unit::Integer: return LengthSystem::None;
  }
  return LengthSystem::None;
}

class ContractCheck {
public:
  ContractCheck(ContractReading &reading, Contract &contract) : reading_(reading), contract_(contract) {}

  void run() {
    checkUnits();
    checkTool();
    if (usesEveryVariable())
      return;
    useOfSetUp();
    for (const EntryValue &param : contract_.params)
      checkRead(param);
    for (const EntryValue &global : contract_.globals)
      checkRead(global);
    for (const Placed &placed : placedExpressions())
      checkUsed(placed);
  }

private:
  const Clause &clause(ClauseId id) const { return reading_.result.clauses[id]; }
  void issue(ContractIssueKind kind, ClauseId id, Span span, std::string detail) {
    addIssue(reading_, {kind, clause(id).source, span, std::move(detail), std::nullopt, contract_.program});
  }

  // ---- units ----

  LengthSystem systemOfModal() const {
    const std::optional<CodeAction> units = unitsOf(contract_, reading_.dialect);
    return !units ? LengthSystem::None : *units == CodeAction::Inch ? LengthSystem::Inch : LengthSystem::Metric;
  }

  void checkUnits() {
    const LengthSystem promised = systemOfModal();
    const EntryValue *first = nullptr;
    for (const std::vector<EntryValue> *list : {&contract_.params, &contract_.globals})
      for (const EntryValue &entry : *list) {
        checkWhole(entry);
        const LengthSystem system = systemOf(entry.unit);
        if (system == LengthSystem::None)
          continue;
        if (promised != LengthSystem::None && promised != system)
          issue(ContractIssueKind::Unit, entry.clause, entry.unitSpan,
                fmt::format("`@MODAL` says {}", promised == LengthSystem::Inch ? "inches" : "millimetres"));
        else if (first && systemOf(first->unit) != system)
          issue(ContractIssueKind::Unit, entry.clause, entry.unitSpan,
                fmt::format("`#{}` is in `{}`, and a program uses only one of the two", first->variable,
                            nameOf(first->unit)));
        first = first ? first : &entry;
      }
  }

  void checkWhole(const EntryValue &entry) {
    if (entry.unit != Unit::Integer)
      return;
    std::vector<ExpressionId> values;
    if (const auto *range = std::get_if<Range>(&entry.values))
      for (const std::optional<ExpressionId> &bound : {range->low, range->high})
        values.insert(values.end(), bound ? 1 : 0, bound.value_or(ExpressionId(0)));
    if (const auto *list = std::get_if<ValueList>(&entry.values))
      values = list->values;
    for (const ExpressionId value : values)
      if (const auto number = constantValue(reading_.result.tree, value); number && !number->isInteger())
        return issue(ContractIssueKind::Unit, entry.clause, entry.unitSpan,
                     fmt::format("it means whole numbers, and {} is not whole",
                                 reading_.result.source(clause(entry.clause).source)
                                     .text(reading_.result.tree.expressions[value].span)));
  }

  // ---- regions ----

  void checkTool() {
    if (contract_.keepIn.empty() && contract_.keepOut.empty())
      return;
    const auto isTool = [&](const Clause &each) {
      return each.kind == ClauseKind::Tool && each.program == contract_.program;
    };
    if (std::ranges::any_of(reading_.result.clauses, isTool))
      return;
    for (const std::vector<Region> *list : {&contract_.keepIn, &contract_.keepOut})
      for (const Region &region : *list)
        issue(ContractIssueKind::RegionWithoutTool, region.clause, clause(region.clause).span, region.name);
  }

  // ---- variables ----

  /// An indirect variable may be any.
  bool usesEveryVariable() {
    for (const VariableUse &use : reading_.model.variablesOf(contract_.program)) {
      if (use.number)
        (use.write ? written_ : read_).insert(*use.number);
      else if (!std::holds_alternative<NamedVariable>(reading_.programTree.expressions[use.expression].node))
        return true;
    }
    for (const Call &call : reading_.model.callsOf(contract_.program)) {
      calls_ = true;
      sharesLocals_ = sharesLocals_ || call.kind == CallKind::Subprogram || call.kind == CallKind::Local ||
                      call.kind == CallKind::External || call.kind == CallKind::Code;
    }
    return false;
  }

  /// The tool is in the spindle and at its place before the call: a macro need not read what they are to depend on it.
  void useOfSetUp() {
    if (contract_.tool) {
      use(contract_.tool->radius);
      if (contract_.tool->corner)
        use(*contract_.tool->corner);
    }
    if (contract_.start)
      for (const AxisValue &axis : contract_.start->axes)
        use(axis.value);
  }
  void use(ExpressionId expression) {
    for (const ExpressionId each : subexpressions(reading_.result.tree, expression))
      if (const std::optional<std::uint32_t> variable = variableNumber(reading_.result.tree, each))
        read_.insert(*variable);
  }

  /// Whether it is for this program alone to use the variable.
  bool isOwn(std::uint32_t variable) const {
    const VariableRange *range = findVariable(reading_.dialect, variable);
    if (!range || range->kind == VariableKind::System)
      return false;
    return range->kind == VariableKind::Local ? !sharesLocals_ : !calls_;
  }

  void checkRead(const EntryValue &entry) {
    if (!isOwn(entry.variable) || read_.contains(entry.variable) || !said_.insert(entry.variable).second)
      return;
    issue(ContractIssueKind::UnusedVariable, entry.clause, entry.variableSpan, "reads");
  }

  struct Placed {
    ClauseId clause;
    ExpressionId expression;
  };
  void checkUsed(const Placed &placed) {
    for (const ExpressionId each : subexpressions(reading_.result.tree, placed.expression)) {
      const std::optional<std::uint32_t> reserved = reservedNumber(reading_.result.tree, each);
      const auto named = reserved ? reservedVariable(*reserved) : std::nullopt;
      const auto *old = named ? std::get_if<OldValueOf>(&*named) : nullptr;
      const std::optional<std::uint32_t> variable =
          old ? std::optional(old->variable) : variableNumber(reading_.result.tree, each);
      if (!variable || *variable == kVacantVariable || !isOwn(*variable) || read_.contains(*variable) ||
          written_.contains(*variable) || !said_.insert(*variable).second)
        continue;
      issue(ContractIssueKind::UnusedVariable, placed.clause, reading_.result.tree.expressions[each].span, "uses");
    }
  }

  std::vector<Placed> placedExpressions() const {
    std::vector<Placed> placed;
    for (const ContractCondition &each : contract_.requirements)
      placed.push_back({each.clause, each.condition});
    for (const Ensure &each : contract_.ensures)
      if (const auto *condition = std::get_if<ExpressionId>(&each.promise))
        placed.push_back({each.clause, *condition});
    for (const AlarmPromise &each : contract_.alarms)
      placed.push_back({each.clause, each.condition});
    for (const std::vector<LoopHint> *list : {&contract_.invariants, &contract_.variants})
      for (const LoopHint &each : *list)
        placed.push_back({each.clause, each.expression});
    const auto programOf = [&](const ReadRange &each) { return clause(each.clause).program; };
    auto each = std::lower_bound(reading_.ranges.begin(), reading_.ranges.end(), contract_.program,
                                 [&](const ReadRange &range, ProgramId program) { return programOf(range) < program; });
    for (; each != reading_.ranges.end() && programOf(*each) == contract_.program; ++each)
      for (const std::optional<ExpressionId> &bound : {each->range.low, each->range.high})
        if (bound)
          placed.push_back({each->clause, *bound});
    return placed;
  }

  ContractReading &reading_;
  Contract &contract_;
  std::set<std::uint32_t> read_;
  std::set<std::uint32_t> written_;
  std::set<std::uint32_t> said_; // each variable once
  bool calls_ = false;
  bool sharesLocals_ = false;
};

} // namespace

void checkContracts(ContractReading &reading) {
  checkRanges(reading);
  std::ranges::stable_sort(reading.ranges, {},
                           [&](const ReadRange &each) { return reading.result.clauses[each.clause].program; });
  for (Contract &contract : reading.result.contracts)
    ContractCheck(reading, contract).run();
}

} // namespace feedhold
