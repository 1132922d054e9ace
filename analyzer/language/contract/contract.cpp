#include "language/contract/contract.h"

#include "language/contract/clauses.h"

#include <algorithm>
#include <tuple>

namespace feedhold {

std::string_view nameOf(ClauseKind kind) {
  static constexpr std::string_view kNames[] = {
#define CLAUSE(kind, name) name,
#include "language/contract/clauses.def"
  };
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view nameOf(Unit unit) {
  static constexpr std::string_view kNames[] = {
#define UNIT(unit, name) name,
#include "language/contract/units.def"
  };
  return kNames[static_cast<std::size_t>(unit)];
}

std::string_view nameOf(ContractIssueKind kind) {
  static constexpr std::string_view kNames[] = {
#define CONTRACT_ISSUE(kind) #kind,
#include "language/contract/issues.def"
  };
  return kNames[static_cast<std::size_t>(kind)];
}

const EntryValue *Contract::param(std::uint32_t variable) const {
  const auto found = std::ranges::find(params, variable, &EntryValue::variable);
  return found == params.end() ? nullptr : &*found;
}

std::optional<CodeAction> unitsOf(const Contract &contract, const Dialect &dialect) {
  for (const ModalCode &code : contract.modal) {
    const Code *row = code.address == 'G' ? findGCode(dialect, code.tenths) : nullptr;
    if (row && (row->action == CodeAction::Inch || row->action == CodeAction::Metric))
      return row->action;
  }
  return std::nullopt;
}

Decimal toleranceOf(const Contract &contract, const Dialect &dialect) {
  if (contract.tolerance)
    return contract.tolerance->most;
  const LeastIncrements increments = leastIncrementsOf(dialect);
  return unitsOf(contract, dialect) == CodeAction::Inch ? increments.inch : increments.metric;
}

Decimal cornerOf(const Contract &contract) { return contract.corner ? contract.corner->most : Decimal::fromInteger(0); }

const Contract *FileContracts::of(ProgramId program) const {
  const auto found = std::ranges::lower_bound(contracts, program, {}, &Contract::program);
  return found == contracts.end() || found->program != program ? nullptr : &*found;
}

void addIssue(ContractReading &reading, ContractIssue issue) { reading.result.issues.push_back(std::move(issue)); }

Contract &contractOf(ContractReading &reading, ProgramId program) {
  std::vector<Contract> &contracts = reading.result.contracts;
  const auto found = std::ranges::lower_bound(contracts, program, {}, &Contract::program);
  if (found != contracts.end() && found->program == program)
    return *found;
  Contract contract;
  contract.program = program;
  return *contracts.insert(found, std::move(contract));
}

namespace {

/// One empty block and the end mark: an expression of a contract stands in a block too.
void addNoBlocks(SyntaxTree &tree) {
  for (int i = 0; i < 2; ++i)
    tree.blocks.add({0, 0, WordId(0), StatementId(0), CommentId(0)});
}

void refuseUnreadable(ContractReading &reading, ContractSourceId id, const Sidecar &sidecar) {
  if (!sidecar.problem)
    return;
  std::vector<ProgramId> programs{programOf(reading.model, sidecar).value_or(ProgramId(0))};
  if (sidecar.scope == SidecarScope::Machine) {
    programs.clear();
    for (const Contract &contract : reading.result.contracts)
      programs.push_back(contract.program);
  }
  for (const ProgramId program : programs) {
    contractOf(reading, program).isSound = false;
    addIssue(reading, {ContractIssueKind::Malformed,
                       id,
                       {},
                       "a text file with one clause a line: " + *sidecar.problem,
                       std::nullopt,
                       program});
  }
}

/// To each program with a contract of its own.
void addSetUp(ContractReading &reading, std::span<const Sidecar> sidecars) {
  for (std::size_t i = 0; i < reading.result.contracts.size(); ++i)
    for (const RawClause &raw : findSetUp(sidecars, reading.result.contracts[i].program))
      readClause(reading, raw);
}

} // namespace

FileContracts readContracts(const SourceFile &source, const SyntaxTree &tree, const ProgramModel &model,
                            const Dialect &dialect, std::span<const Sidecar> sidecars) {
  ContractReading reading{source, tree, model, dialect};
  addNoBlocks(reading.result.tree);
  reading.result.sources.push_back(source);
  for (const Sidecar &sidecar : sidecars)
    reading.result.sources.push_back(sidecar.source);
  std::vector<RawClause> clauses = findClauses(reading, sidecars);
  dropRemarks(reading, clauses);
  if (!clauses.empty())
    reading.jumpHeads = jumpHeads(model);
  for (const RawClause &raw : clauses)
    readClause(reading, raw);
  addSetUp(reading, sidecars);
  for (std::size_t i = 0; i < sidecars.size(); ++i)
    refuseUnreadable(reading, ContractSourceId(i + 1), sidecars[i]);
  if (!clauses.empty())
    checkContracts(reading);
  const auto place = [](const ContractIssue &issue) { return std::tuple(issue.source, issue.span.begin); };
  std::ranges::stable_sort(reading.result.issues, {}, place);
  return std::move(reading.result);
}

} // namespace feedhold
