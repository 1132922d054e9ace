#include "proof/context/call_promises.h"

#include "language/contract/assigned_cells.h"
#include "meaning/cfg/reached_programs.h"
#include "proof/symbolic/modal_parts.h"
#include "proof/symbolic/path_memory.h"

#include <algorithm>
#include <iterator>

namespace feedhold::prove {

using smt::TermId;

namespace {

constexpr std::size_t kMostWritten = 200; // variables that are told one by one
constexpr std::uint32_t kLastVariable = 0xffffffff;

/// Those that a program owns together with others; what the control shows of itself, or changes by itself, is no
/// matter of `@ASSIGNS`, and the other system variables are left out with it.
bool isShared(const VariableRange &row) {
  return (row.kind == VariableKind::Common || row.kind == VariableKind::Retentive) &&
         (row.role == VariableRole::Plain || row.role == VariableRole::Stored);
}

/// Ranges that lie side by side, or between which there is nothing that is kept, as one.
std::vector<VariableSpan> lostSpans(const Dialect &dialect, const std::set<std::uint32_t> &assigned) {
  std::vector<VariableSpan> lost;
  bool isSideBySide = false;
  const auto lose = [&](std::uint32_t first, std::uint32_t last) {
    if (isSideBySide)
      lost.back() = {std::min(lost.back().first, first), std::max(lost.back().last, last)};
    else
      lost.push_back({first, last});
    isSideBySide = true;
  };
  for (const VariableRange &row : dialect.variables) {
    if (row.kind == VariableKind::Local)
      continue;
    if (!isShared(row)) {
      lose(row.first, row.last);
      continue;
    }
    for (std::uint32_t next = row.first; next <= row.last;) {
      const auto cell = assigned.lower_bound(next);
      const bool isEnd = cell == assigned.end() || *cell > row.last;
      isSideBySide = isSideBySide && !isEnd && *cell == next;
      if (isEnd)
        break;
      lose(*cell, *cell);
      next = *cell + 1;
    }
  }
  lose(kFirstPredefinedName, kLastVariable); // `#<_value>`, too
  return lost;
}

class ContractOfCallee : public CalledContract {
public:
  ContractOfCallee(SymbolicInterpretation &interpretation, const ProgramSet &programs, FileId reader,
                   const FileContracts &file, const Contract &contract, std::string name)
      : interpretation_(interpretation), dialect_(*programs.file(reader).dialect), file_(file), contract_(contract),
        name_(std::move(name)), terms_(interpretation, programs, reader, file) {}

  const std::string &name() const override { return name_; }
  const FileContracts &file() const override { return file_; }
  const Contract &contract() const override { return contract_; }

  std::vector<TermId> demands(const SymbolicState &entered) override {
    return demandsOfCall(interpretation_.store(), terms_, contract_, entered, dialect_);
  }

  void keep(const SymbolicState &before, SymbolicState &now) override {
    if (!contract_.assigns.empty())
      keepVariables(before, now);
    for (const Ensure &ensure : contract_.ensures)
      if (const auto *kept = std::get_if<ModalPreserved>(&ensure.promise))
        keepModalState(interpretation_, dialect_, *kept, before, now);
    for (const Ensure &ensure : contract_.ensures)
      if (const auto *codes = std::get_if<std::vector<ModalCode>>(&ensure.promise))
        bringIntoForce(*codes, now);
  }

  std::vector<TermId> promises(const SymbolicState &entered, const SymbolicState &returned) override {
    std::vector<TermId> all;
    for (const Ensure &ensure : contract_.ensures)
      if (const auto *expression = std::get_if<ExpressionId>(&ensure.promise))
        all.push_back(terms_.promise(contract_, *expression, entered, returned));
    return all;
  }

  std::optional<std::vector<std::uint32_t>> written() const override {
    if (contract_.assigns.empty())
      return std::nullopt;
    const std::set<std::uint32_t> cells = assignedCells(dialect_, contract_.assigns);
    return cells.size() > kMostWritten ? std::nullopt : std::optional(std::vector(cells.begin(), cells.end()));
  }

private:
  /// Anything may have been written to all others, and to what may be the same cell.
  void keepVariables(const SymbolicState &before, SymbolicState &now) const {
    const auto callers = now.variables;
    now.variables = before.variables;
    now.havocked = before.havocked;
    for (const VariableSpan &span : lostSpans(dialect_, assignedCells(dialect_, contract_.assigns))) {
      interpretation_.havocVariables(now, span.first, span.last);
      for (const VariableSpan &other : cellsBeside(dialect_, span.first, std::min(span.last, kFirstNamedVariable)))
        interpretation_.havocVariables(now, other.first, other.last);
    }
    for (const auto &[variable, value] : callers.entries()) // names of the calling level, which no other program sees
      if (variable >= kFirstNamedVariable && !isPathMemory(variable))
        now.variables.set(variable, value);
  }

  void bringIntoForce(const std::vector<ModalCode> &codes, SymbolicState &now) const {
    const ModalTable modes(dialect_);
    for (const ModalCode &code : codes) {
      const Code *row = code.address == 'G' ? findGCode(dialect_, code.tenths) : nullptr;
      if (const auto index = row ? modes.indexOf(*row) : std::nullopt)
        now.codes[row->group] = interpretation_.code(*index);
    }
  }

  SymbolicInterpretation &interpretation_;
  const Dialect &dialect_;
  const FileContracts &file_;
  const Contract &contract_;
  std::string name_;
  ContractTerms terms_;
};

/// A program that is meant to run for ever returns nothing; a contract with a mistake says nothing for certain.
bool canStandForText(const Contract &contract) {
  return contract.isSound && !contract.cyclic && (!contract.ensures.empty() || !contract.assigns.empty());
}

/// Which offsets a text uses that is not there, and what has to hold of them, is not known.
bool speaksOfOffsets(const Contract &contract) { return contract.machine || !contract.lengths.empty(); }

} // namespace

std::vector<TermId> demandsOfCall(smt::TermStore &store, ContractTerms &terms, const Contract &contract,
                                  const SymbolicState &entered, const Dialect &dialect) {
  std::vector<TermId> demands = terms.assumptions(contract, entered);
  if (contract.machine) {
    const SpaceClaims space(store, terms, contract, entered, dialect, smt::Number(0));
    std::ranges::copy(space.startIsOutside(), std::back_inserter(demands));
  }
  return demands;
}

CallContracts callContracts(SymbolicInterpretation &interpretation, const ProofSubject &subject) {
  return [&interpretation, &subject](FileId from, const Call &call,
                                     const std::optional<Callee> &callee) -> std::shared_ptr<CalledContract> {
    const auto of = [&](FileId reader, const FileContracts *file, ProgramId program, std::string name) {
      const Contract *contract = file ? file->of(program) : nullptr;
      return contract && canStandForText(*contract)
                 ? std::make_shared<ContractOfCallee>(interpretation, subject.programs, reader, *file, *contract,
                                                      std::move(name))
                 : nullptr;
    };
    if (callee)
      return of(callee->file, subject.contractsOf(*callee), callee->program, subject.nameOf(*callee));
    const auto missing = call.callee.number ? subject.options.missingContracts.find(*call.callee.number)
                                            : subject.options.missingContracts.end();
    if (missing == subject.options.missingContracts.end())
      return nullptr;
    const Contract *contract = missing->second->of(ProgramId(0));
    return contract && speaksOfOffsets(*contract) ? nullptr
                                                  : of(from, missing->second, ProgramId(0), toString(call.callee));
  };
}

bool callsPromising(const ProofSubject &subject) {
  ReachedPrograms reached;
  collectReached(subject.programs, {subject.program.file, subject.program.program}, reached);
  return std::ranges::any_of(reached.programs, [&](const ProgramRef &each) {
    const bool isOwn = each.file == subject.program.file && each.program == subject.program.program;
    const FileContracts *contracts =
        isOwn ? nullptr
              : subject.contractsOf(
                    {each.file, subject.programs.file(each.file).cfg.entryOf(each.program), each.program});
    return contracts && canStandForText(*contracts->of(each.program));
  });
}

} // namespace feedhold::prove
