#include "proof/context/proof_start.h"

#include "meaning/semantics/mappings.h"
#include "proof/context/call_promises.h"
#include "proof/context/head_bounds.h"
#include "proof/context/index_ranges.h"
#include "proof/obligation/obligation_kinds.h"
#include "proof/replay/exact_run.h"
#include "proof/replay/start_inputs.h"
#include "proof/space/plain_space.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <set>

namespace feedhold::prove {

using smt::TermId;

std::vector<double> ProofSubject::constants() const {
  std::set<double> constants;
  const auto collect = [&](const SyntaxTree &tree) {
    for (const Expression &expression : tree.expressions)
      if (const auto *literal = std::get_if<NumberLiteral>(&expression.node); literal && constants.size() < 24)
        constants.insert(literal->value.toDouble());
  };
  if (contracts)
    collect(contracts->tree);
  collect(*file().tree);
  return {constants.begin(), constants.end()};
}

bool ProofSubject::wants(ObligationKind kind) const {
  return options.only.empty() || std::find(options.only.begin(), options.only.end(), kind) != options.only.end();
}

const FileContracts *ProofSubject::contractsOf(const Callee &callee) const {
  const std::size_t index = callee.file.index();
  const FileContracts *of = index < options.contractsOf.size() ? options.contractsOf[index] : nullptr;
  return of && of->of(callee.program) ? of : nullptr;
}

std::string ProofSubject::nameOf(const Callee &callee) const {
  return toString(programs.file(callee.file).model->programs[callee.program].name);
}

std::string ProofSubject::lineOf(Place place) const {
  const ProgramFile &where = programs.file(place.file);
  const BlockId block = programs.node(place).block;
  const std::uint32_t line = where.source->lineOf(where.tree->blocks[block].span().begin);
  const ProgramId owner = where.model->programOf(block);
  return place.file == program.file && owner == program.program
             ? fmt::format("line {}", line)
             : fmt::format("line {} of {}", line, toString(where.model->programs[owner].name));
}

bool ProofSubject::isOwn(Place place) const {
  return place.file == program.file && file().model->programOf(programs.node(place).block) == program.program;
}

/// Its name is `O9100.loop-ends.N20`: by the sequence number of the block, or by its line.
Obligation ProofSubject::obligation(ObligationKind kind, Place place, Span span, std::string claim) const {
  const BlockId block = programs.node(place).block;
  std::string at = fmt::format("L{}", file().source->lineOf(span.begin));
  for (const SequenceNumber &number : file().model->sequenceNumbersOf(program.program))
    if (number.block == block) {
      at = fmt::format("N{}", number.number);
      break;
    }
  return {.kind = kind,
          .id = fmt::format("{}.{}.{}", name(), prove::nameOf(kind), at),
          .place = place,
          .span = span,
          .claim = std::move(claim)};
}

ProofStart::ProofStart(const ProofSubject &subject, const GivenVariables *given)
    : interpretation_(store_, subject.dialect(), subject.options.arithmetic) {
  if (subject.contract())
    interpretation_.assumeInputs(writtenInputs(*subject.contracts, *subject.contract()));
  if (given)
    startExactly(interpretation_, *given);
  else
    interpretation_.suggestIndices(indexRangesOf(subject.programs, subject.program, subject.contracts));
  entry_ = symbolicEntry(interpretation_);
  if (given)
    setStart(interpretation_, entry_, given->start);
  keepPolar(subject.dialect());
  anyEntry_ = entry_;
  codes_ = entry_.codes;
  if (subject.contract())
    readContract(subject);
}

void ProofStart::keepPolar(const Dialect &dialect) {
  const ModalTable modes(dialect);
  const auto polar = modes.groupOf(ModalKind::Polar);
  if (!polar)
    return;
  interpretation_.keepPolar(*polar);
  const CodeMask off = modes.maskOf(ModalKind::Polar, {CodeAction::PolarOff});
  if (off != 0)
    entry_.codes[*polar] = interpretation_.code(static_cast<std::uint8_t>(std::countr_zero(off)));
}

void ProofStart::readContract(const ProofSubject &subject) {
  const Contract &contract = *subject.contract();
  terms_ = std::make_unique<ContractTerms>(interpretation_, subject.programs, subject.program.file, *subject.contracts);
  terms_->prepare(contract, entry_);
  codes_ = entry_.codes;
  leaveMappingsOpen(subject);
  demands_ = terms_->demands(contract, entry_);
  const smt::Number tolerance = interpretation_.arithmetic() == Arithmetic::Exact
                                    ? smt::Number(0)
                                    : smt::Number::fromDouble(toleranceOf(contract, subject.dialect()).toDouble());
  space_ = std::make_unique<SpaceClaims>(store_, *terms_, contract, entry_, subject.dialect(), tolerance);
  std::ranges::copy(space_->startIsOutside(), std::back_inserter(demands_));
}

/// A mapping whose code is certain is taken to be the program's own; one of the caller ends with what was known of the
/// position, so that its code is left open.
void ProofStart::leaveMappingsOpen(const ProofSubject &subject) {
  for (const ModalCode &code : subject.contract()->modal) {
    const Code *row = code.address == 'G' ? findGCode(subject.dialect(), code.tenths) : nullptr;
    if (row && beginsMapping(row->action))
      entry_.codes[row->group] = anyEntry_.codes[row->group];
  }
}

RunOptions ProofStart::runStart() const {
  RunOptions options;
  for (std::size_t group = 0; group < kModalGroups; ++group)
    if (const TermId code = codes_[group].index; store_.isNumber(code))
      options.codes.emplace_back(static_cast<std::uint8_t>(group),
                                 static_cast<std::uint8_t>(store_[code].number.toDouble()));
  return options;
}

std::map<Axis, TermId> ProofStart::place() const {
  std::map<Axis, TermId> place;
  for (const Axis axis : kAllAxes)
    if (const TermId at = entry_.at(axis).number; at != anyEntry_.at(axis).number)
      place.emplace(axis, at);
  return place;
}

StartInputs ProofStart::openStart(const Dialect &dialect) const { return {store_, dialect, entry_, place()}; }

Query ProofStart::onPath(const std::vector<TermId> &conditions, TermId goal) {
  const std::vector<TermId> &facts = interpretation_.facts();
  facts_.add(facts);
  Query query = relevantQuery(store_, facts_, facts, conditions, goal);
  for (const TermId condition : conditions) { // the path itself may be what is impossible
    const Query part = relevantQuery(store_, facts_, facts, {}, condition);
    query.assumptions.insert(query.assumptions.end(), part.assumptions.begin(), part.assumptions.end());
    query.assumptions.push_back(condition);
  }
  std::sort(query.assumptions.begin(), query.assumptions.end());
  query.assumptions.erase(std::unique(query.assumptions.begin(), query.assumptions.end()), query.assumptions.end());
  return query;
}

/// By the clauses of the contract, or the radius of its tool.
OffsetOfCutter ProofStart::cutterOffsets(const Contract &contract) {
  if (!contract.tool && contract.offsets.empty())
    return nullptr;
  if (interpretation_.dialect().machine == MachineKind::Turning)
    return [this, &contract](const SymbolicValue &, const auto &) { return noseOf(contract); };
  return [this, &contract](const SymbolicValue &number, const auto &proves) -> std::optional<PathOffset> {
    const auto termOf = [&](ExpressionId expression) { return terms_->number(expression, entry_, entry_); };
    const RadiusOffset *found = nullptr;
    for (const RadiusOffset &offset : contract.offsets) {
      const TermId same = offset.number ? store_.equal(number.number, termOf(*offset.number)) : store_.no();
      if (offset.number ? proves(same) : found == nullptr)
        found = &offset;
      else if (offset.number && !proves(store_.logicalNot(same)))
        return std::nullopt;
    }
    if (found)
      return rangeOf(*found, number.number);
    if (!contract.offsets.empty())
      return std::nullopt;
    return PathOffset{.radius = registerOf(contract.tool->radius), .isAssumed = true};
  };
}

/// A register holds increments.
TermId ProofStart::registerOf(ExpressionId radius) {
  return interpretation_.asCounted(terms_->number(radius, entry_, entry_));
}

/// Of a lathe: that of the tool, whichever offset it is; `@OFFSET` tells offsets of D.
std::optional<PathOffset> ProofStart::noseOf(const Contract &contract) {
  if (!contract.tool || !contract.offsets.empty())
    return std::nullopt;
  return PathOffset{.radius = registerOf(contract.tool->radius), .tip = tipDirection(contract.tool->direction)};
}

/// A range holds one radius for each D, in the whole run.
PathOffset ProofStart::rangeOf(const RadiusOffset &offset, TermId number) {
  const auto &[low, high] = offset.radius;
  if (low == high)
    return {.radius = registerOf(*low)};
  auto [known, isNew] = radii_.try_emplace({offset.clause.index(), number}, number);
  if (isNew)
    known->second = interpretation_.fresh("offset", smt::Sort::Real);
  PathOffset result{.radius = known->second};
  if (low)
    result.conditions.push_back(store_.lessOrEqual(registerOf(*low), result.radius));
  if (high)
    result.conditions.push_back(store_.lessOrEqual(result.radius, registerOf(*high)));
  return result;
}

std::vector<std::pair<double, double>> ProofStart::offsetsIn(const smt::Model &model) const {
  std::vector<std::pair<double, double>> offsets;
  for (const auto &[key, radius] : radii_) {
    const auto held = model.find(store_[radius].name);
    const auto number = held == model.end() ? std::nullopt : smt::evaluate(store_, key.second, model);
    if (number)
      offsets.emplace_back(std::get<smt::Number>(*number).toDouble(), std::get<smt::Number>(held->second).toDouble());
  }
  return offsets;
}

/// Hints are tried, never believed: an invariant has to hold before each iteration, a ranking function has to fall.
ExploreOptions ProofStart::exploreOptions(const ProofSubject &subject, ExploreOptions options) {
  options.assumptions = demands_;
  options.missing = subject.options.missing;
  options.missingChangeNothing = subject.options.missingChangeNothing;
  options.takesFewPasses = subject.options.takesFewPasses;
  const bool isExact = interpretation_.arithmetic() == Arithmetic::Exact;
  options.contracts = callContracts(interpretation_, subject);
  options.relyOn = options.missing == MissingPrograms::Return ? Reliance::Missing : Reliance::Nobody;
  options.demands = [&subject, isExact](const Callee &callee) { return !isExact || subject.contractsOf(callee); };
  const Contract *contract = subject.contract();
  options.boundsAt = [this, &subject](const std::set<Place> &heads) {
    return boundsAt(heads, store_, subject.programs, subject.program, subject.contracts);
  };
  options.leavesSteps = !contract; // there are few of them without one
  if (!contract)
    return options;
  options.keepWrites = !contract->assigns.empty();
  options.fixed = fixedAxes(*contract);
  const bool asksOfSpace = hasSpaceClause(*contract) &&
                           std::ranges::any_of(kSpaceKinds, [&](ObligationKind kind) { return subject.wants(kind); });
  if (subject.wants(ObligationKind::Compensation) || asksOfSpace)
    options.cutterOffset = cutterOffsets(*contract);
  options.moves = contract->clearance && subject.wants(ObligationKind::Clearance)    ? KeepMoves::WithColumn
                  : asksOfSpace || !contract->limits.empty() || options.cutterOffset ? KeepMoves::Yes
                                                                                     : KeepMoves::No;
  const auto hintsOf = [&subject](const std::vector<LoopHint> &hints, HintTerm termOf) {
    return [&subject, &hints, termOf = std::move(termOf)](Place head, const SymbolicState &state) {
      std::vector<TermId> terms;
      for (const LoopHint &hint : hints)
        if (head.file == subject.program.file && subject.programs.node(head).block == hint.block)
          terms.push_back(termOf(hint.expression, state));
      return terms;
    };
  };
  options.invariants = [this, asksOfSpace,
                        hints = hintsOf(contract->invariants, [this](ExpressionId hint, const auto &state) {
                          return terms_->condition(hint, entry_, state);
                        })](Place head, const SymbolicState &state) {
    std::vector<TermId> all = hints(head, state);
    if (asksOfSpace) {
      const std::vector<TermId> inSpace = space_->hints(state);
      all.insert(all.end(), inSpace.begin(), inSpace.end());
    }
    return all;
  };
  options.rankingHints = hintsOf(
      contract->variants, [this](ExpressionId hint, const auto &state) { return terms_->number(hint, entry_, state); });
  return options;
}

} // namespace feedhold::prove
