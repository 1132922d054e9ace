// Regions, clearance and travel: the tool goes only where the contract lets it (docs/geometry.md).
#include "language/dialect/code_name.h"
#include "proof/families/families.h"
#include "proof/families/input_signs.h"
#include "proof/families/space_runs.h"
#include "proof/smt/plain_values.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace feedhold::prove {

using smt::TermId;

namespace {

using Moves = std::vector<const MoveInstance *>;

constexpr std::uint64_t kSearchOfClaim = 40'000;
constexpr std::uint64_t kSearchOfCorners = 4'000; // of a margin

/// Some of the sampled runs, as values of terms: what is not so in one of them need not be searched a proof for.
class SampledTerms {
public:
  explicit SampledTerms(const ProofContext &context) {
    constexpr std::size_t kMost = 3;
    const auto &samples = context.witnesses.samples();
    for (std::size_t i = 0; i < std::min(kMost, samples.size()); ++i)
      runs_.emplace_back(context.start.store(),
                         context.witnesses.modelOf(samples[i * (samples.size() - 1) / kMost].given));
  }

  bool deny(const std::vector<TermId> &conditions, const SpaceQuestion::Alternative &alternative) {
    return std::ranges::any_of(runs_, [&](smt::PlainValues &run) {
      for (const auto &[variable, value] : alternative.example)
        run.set(variable, value);
      return run.is(alternative.goal, false) &&
             std::ranges::all_of(conditions, [&](TermId condition) { return run.is(condition, true); });
    });
  }

private:
  std::vector<smt::PlainValues> runs_;
};

/// A distance that the tool may keep.
struct MarginGuess {
  double margin;
  std::uint64_t search; // that it is worth where corners do not show it; 0: none
};

/// Answers the questions of all rules.
class SpaceProver {
public:
  explicit SpaceProver(const ProofContext &context)
      : context_(context), start_(context.start), space_(context.start.space()),
        signs_(signsOfInputs(context.start, context.found)), samples_(context) {}

  /// Of one block and what it calls.
  Obligation row(const SpaceRule &rule, Place own, const Moves &moves);

private:
  Verdict decide(Obligation &row, const SpaceRule &rule, const Moves &moves, const SpaceRuns &runs);
  std::optional<Verdict> notAsked(const SpaceRule &rule, Place own);
  std::optional<Verdict> missingPremise(std::uint64_t &effort, Proof &proof, const SpaceRule &rule, const Moves &moves);
  void addMargin(Obligation &row, const SpaceRule &rule, const Moves &moves);
  std::optional<double> nearest(const SpaceRule &rule, Place own);
  bool keepsAway(const SpaceRule &rule, const Moves &moves, const MarginGuess &guess);
  struct Try {
    const std::vector<TermId> &conditions;
    const SpaceQuestion &question;
    const Budget &budget;
    std::uint64_t corners; // search for all alternatives but the last: where corners will do, they do so at once
  };
  bool isProved(const Try &asked, std::uint64_t &effort, Proof &proof, std::optional<smt::Model> *model = nullptr);
  bool isProved(const Try &asked, const SpaceQuestion::Alternative &alternative, std::uint64_t &effort, Proof &proof,
                std::optional<smt::Model> *model);
  const Outcome &answered(const Query &query, const Budget &budget);
  bool isGivenAtStart(Axis axis) const;
  std::string whyOpen(const MoveInstance &move, const SpaceQuestion &question);

  const ProofContext &context_;
  ProofStart &start_;
  const SpaceClaims &space_;
  std::vector<TermId> signs_; // facts about the inputs that the contract allows
  SampledTerms samples_;
  std::map<TermId, Outcome> soundness_;                                      // of rules: SpaceRule::isSound
  std::map<const SpaceRule *, std::map<Place, double>> nearest_;             // by block
  std::map<std::pair<std::vector<TermId>, std::uint64_t>, Outcome> answers_; // by assumptions with the goal, budget
};

Obligation SpaceProver::row(const SpaceRule &rule, Place own, const Moves &moves) {
  const ProofSubject &subject = context_.subject;
  Obligation row = subject.obligation(rule.kind, own, subject.spanOf(own), subject.textOf(rule.clause));
  if (!rule.name.empty())
    row.id.insert(row.id.rfind('.'), "." + rule.name);
  if (const Obligation *known = context_.decidedAs(row))
    return *known;
  const SpaceRuns runs(context_, rule, own);
  row.tolerance = runs.tolerance();
  if (auto decided = decidedBefore(context_, runs.violation()))
    row.verdict = *std::move(decided);
  else
    row.verdict = decide(row, rule, moves, runs);
  if (verdict::Proved *proved = row.verdict.proved()) {
    if (auto rounded = subject.options.arithmetic == Arithmetic::Exact ? runs.roundedAway() : std::nullopt) {
      proved->exactOnly = true;
      proved->why = *std::move(rounded);
    }
    addMargin(row, rule, moves);
  }
  if (const Witness *witness = row.verdict.witness())
    row.verdict = runs.located(*witness);
  return row;
}

/// Of a distance the first two digits.
double twoDigits(double distance) {
  const double size = std::pow(10, std::floor(std::log10(distance)) - 1);
  return std::floor(distance / size + SpaceRuns::kTouches) * size;
}

/// How far the sampled runs keep away, or a part of it that can be proved; 0 where one reaches the boundary.  Where
/// coordinates are rounded, a guess as far as they keep is mostly not so; and the larger a guess, the less a part of it
/// is worth a long search.
std::vector<MarginGuess> guessesOf(double nearest, double rounding) {
  constexpr std::uint64_t kShort = 2'000, kLong = 30'000;
  std::vector<MarginGuess> guesses{{twoDigits(nearest), kShort}};
  if (nearest - guesses.front().margin < rounding && nearest - rounding > SpaceRuns::kTouches)
    guesses.push_back({twoDigits(nearest - rounding), kShort});
  for (const double part : {0.9, 0.8, 0.7, 0.6})
    guesses.push_back({twoDigits(nearest * part), 0});
  for (const double part : {0.5, 0.1})
    guesses.push_back({twoDigits(nearest * part), kLong});
  return guesses;
}

void SpaceProver::addMargin(Obligation &row, const SpaceRule &rule, const Moves &moves) {
  constexpr std::uint64_t kCheap = 100'000; // effort of the proof
  if (!rule.spacesFor || row.effort > kCheap)
    return;
  const std::optional<double> nearest = this->nearest(rule, row.place);
  if (!nearest)
    return;
  std::optional<double> &margin = row.verdict.proved()->margin;
  if (*nearest < SpaceRuns::kTouches) {
    margin = 0;
    return;
  }
  for (const MarginGuess &guess : guessesOf(*nearest, 2 * row.tolerance.value_or(0)))
    if (keepsAway(rule, moves, guess)) {
      margin = guess.margin;
      return;
    }
}

/// Of the sampled runs; absent: none of them moves there.
std::optional<double> SpaceProver::nearest(const SpaceRule &rule, Place own) {
  auto known = nearest_.find(&rule);
  if (known == nearest_.end())
    known = nearest_.emplace(&rule, SpaceRuns::nearest(context_, rule)).first;
  const auto found = known->second.find(own);
  return found != known->second.end() ? std::optional(found->second) : std::nullopt;
}

bool SpaceProver::keepsAway(const SpaceRule &rule, const Moves &moves, const MarginGuess &guess) {
  const SpaceRule wider = space_.withMargin(rule, guess.margin);
  const Budget budget{.search = guess.search, .z3 = 0, .cvc5 = 0};
  std::uint64_t effort = 0;
  Proof proof;
  return std::all_of(moves.begin(), moves.end(), [&](const MoveInstance *move) {
    const std::vector<SpaceQuestion> questions = space_.questions(wider, *move);
    return std::all_of(questions.begin(), questions.end(), [&](const SpaceQuestion &question) {
      return isProved({move->conditions, question, budget, kSearchOfCorners}, effort, proof);
    });
  });
}

std::optional<Verdict> SpaceProver::notAsked(const SpaceRule &rule, Place own) {
  if (rule.missing)
    return Verdict::unknown(*rule.missing);
  for (const UnmodelledCall &call : context_.found.unmodelledCalls)
    if (call.own == own)
      return Verdict::unknown(fmt::format("{}; the call may move the tool", call.why), own);
  const auto [known, isNew] = soundness_.try_emplace(rule.isSound);
  if (isNew)
    known->second =
        discharge(start_.store(), start_.onPath(start_.demands(), rule.isSound), context_.subject.options.budget);
  const Outcome &soundness = known->second;
  if (const auto *open = std::get_if<Unknown>(&soundness.answer))
    return Verdict::unknown(open->reason);
  if (!soundness.proved())
    return Verdict::unknown(
        "some calls make the tool or the region invalid (a negative radius, a range from high to low, a "
        "polygon whose sides cross); exclude them with `@REQUIRE`");
  return std::nullopt;
}

/// Coordinates are those of the tool.
std::optional<Verdict> SpaceProver::missingPremise(std::uint64_t &effort, Proof &proof, const SpaceRule &rule,
                                                   const Moves &moves) {
  for (const MoveInstance *move : moves) {
    if (const auto reason = space_.whyNotTold(*move))
      return Verdict::unknown(context_.found.unmodelledAt(move->place).value_or(*reason), move->place);
    for (const auto &[premise, reason] : space_.premises(rule, *move))
      if (!isProved(
              {move->conditions, {{{{}, premise}}}, context_.budget, std::min(kSearchOfClaim, context_.budget.search)},
              effort, proof))
        return Verdict::unknown(reason, move->place);
  }
  return std::nullopt;
}

Verdict SpaceProver::decide(Obligation &row, const SpaceRule &rule, const Moves &moves, const SpaceRuns &runs) {
  if (auto open = notAsked(rule, row.place))
    return *std::move(open);
  verdict::Proved proved;
  if (auto open = missingPremise(row.effort, proved.proof, rule, moves))
    return *std::move(open);
  for (const MoveInstance *move : moves)
    for (const SpaceQuestion &question : space_.questions(rule, *move)) {
      std::optional<smt::Model> model;
      if (isProved({move->conditions, question, context_.budget, std::min(kSearchOfClaim, context_.budget.search)},
                   row.effort, proved.proof, &model))
        continue;
      if (model)
        if (auto witness = context_.witnesses.fromModel(*model, runs.violation()))
          return *std::move(witness);
      return Verdict::unknown(whyOpen(*move, question), move->place);
    }
  return proved;
}

/// Movements on one level ask the same of it.
const Outcome &SpaceProver::answered(const Query &query, const Budget &budget) {
  std::vector<TermId> key = query.assumptions;
  key.push_back(query.goal);
  auto [known, isNew] = answers_.try_emplace({std::move(key), budget.search});
  if (isNew)
    known->second = discharge(start_.store(), query, budget);
  return known->second;
}

/// By one of its alternatives: the model is that of the last one.
bool SpaceProver::isProved(const Try &asked, std::uint64_t &effort, Proof &proof, std::optional<smt::Model> *model) {
  return std::any_of(asked.question.alternatives.begin(), asked.question.alternatives.end(),
                     [&](const SpaceQuestion::Alternative &alternative) {
                       return isProved(asked, alternative, effort, proof, model);
                     });
}

bool SpaceProver::isProved(const Try &asked, const SpaceQuestion::Alternative &alternative, std::uint64_t &effort,
                           Proof &proof, std::optional<smt::Model> *model) {
  std::vector<TermId> all = asked.conditions;
  all.insert(all.end(), alternative.conditions.begin(), alternative.conditions.end());
  all.insert(all.end(), signs_.begin(), signs_.end());
  const std::vector<SpaceQuestion::Alternative> &alternatives = asked.question.alternatives;
  const bool isLast = &alternative == &alternatives.back();
  if ((isLast && alternatives.size() > 1 && asked.budget.search == 0) || (!isLast && samples_.deny(all, alternative)))
    return false;
  const Budget corners{.search = asked.corners, .z3 = 0, .cvc5 = 0};
  const Budget &budget = isLast && asked.budget.search > 0 ? asked.budget : corners;
  const smt::TermStore &store = start_.store();
  const std::vector<TermId> parts = store[alternative.goal].kind == smt::TermKind::And
                                        ? store[alternative.goal].arguments
                                        : std::vector{alternative.goal};
  std::vector<Outcome> proofs;
  for (const TermId part : parts) {
    const bool holdsAnyway = part == store.yes(); // most premises
    Outcome outcome = answered(holdsAnyway ? Query{{}, part} : start_.onPath(all, part), budget);
    if (!outcome.proved()) {
      effort += outcome.effort;
      if (isLast && model != nullptr && outcome.counterexample() != nullptr)
        *model = *outcome.counterexample();
      return false;
    }
    proofs.push_back(std::move(outcome));
  }
  for (Outcome &each : proofs) {
    effort += each.effort;
    proof.add(std::move(each));
  }
  return true;
}

std::optional<std::string> additionalClauseOf(const Dialect &dialect, std::uint32_t variable) {
  const Code *code = additionalOffsetCode(dialect);
  for (std::uint32_t number = 1; code != nullptr; ++number) {
    const auto first = additionalWorkOffset(dialect, number);
    if (!first)
      break;
    if (*first <= variable && variable < *first + kAxisCount)
      return fmt::format("@OFFSET {} P{} {}..", textOf(CodeName{'G', code->tenths}), number,
                         kAxisLetters[variable - *first]);
  }
  return std::nullopt;
}

/// The clause that says what a variable of the set-up holds.
std::optional<std::string> setUpClauseOf(const Dialect &dialect, std::uint32_t variable) {
  const VariableRange *range = findVariable(dialect, variable);
  if (range && range->role == VariableRole::WorkOffset) {
    const std::uint32_t row = (variable - kFirstWorkOffset) / kWorkOffsetStride;
    const std::uint32_t axis = (variable - kFirstWorkOffset) % kWorkOffsetStride;
    if (axis < kAxisCount)
      return fmt::format("@OFFSET {} {}..", row == 0 ? "EXT" : fmt::format("G{}", 53 + row), kAxisLetters[axis]);
  }
  if (range && range->role == VariableRole::AdditionalWorkOffset)
    return additionalClauseOf(dialect, variable);
  if (range && range->role == VariableRole::Reference)
    return "@MACHINE .. HOME ..";
  const OffsetMemory &lengths = dialect.behaviour.lengthOffsets;
  for (std::uint32_t number = 1; number <= lengths.count; ++number)
    if (const auto cells = lengthVariables(dialect, number); variable == cells[0] || variable == cells[1])
      return fmt::format("@LENGTH H{} ..", number);
  return std::nullopt;
}

bool isStated(const Contract &contract, const Dialect &dialect, std::uint32_t variable) {
  if (std::ranges::find(contract.globals, variable, &EntryValue::variable) != contract.globals.end())
    return true;
  return std::ranges::any_of(contract.lengths, [&](const LengthRange &length) {
    return length.number ? std::ranges::count(lengthVariables(dialect, *length.number), variable) != 0
                         : isLengthVariable(dialect, variable);
  });
}

bool namesAdditionalOffset(const ProgramFile &file) {
  return std::ranges::any_of(file.tree->words, [&](const Word &word) {
    const auto tenths = word.address() == 'G' ? word.tenths() : std::nullopt;
    const Code *code = tenths ? findGCode(*file.dialect, *tenths) : nullptr;
    return code != nullptr && code->action == CodeAction::ExtendedWorkOffset;
  });
}

bool SpaceProver::isGivenAtStart(Axis axis) const {
  const auto &start = context_.subject.contract()->start;
  return start && std::any_of(start->axes.begin(), start->axes.end(),
                              [&](const AxisValue &value) { return value.axis == letterOf(axis); });
}

/// What the start leaves open, if the claim speaks of it.
std::string SpaceProver::whyOpen(const MoveInstance &move, const SpaceQuestion &question) {
  if (context_.subject.dialect().machine == MachineKind::Turning && move.point.withLength.term == start_.store().yes())
    return "the tool has been changed, and where its tip is before the next move of both axes is unknown, since tool "
           "offsets are the operator's";
  const Query query = start_.onPath(move.conditions, question.alternatives.back().goal);
  const std::vector<TermId> &named = smt::variablesOf(start_.store(), query.goal);
  const std::set<TermId> variables(named.begin(), named.end());
  const auto length = space_.lengthInSpindle();
  const auto ofLength = [&](TermId variable) { return variables.contains(variable); };
  if (length && std::ranges::any_of(smt::variablesOf(start_.store(), *length), ofLength))
    return "it is not certain that a tool length is in force in this block (G43 with an H other than 0), and the "
           "tool may have any length of `@LENGTH`";
  std::string axes;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
    if (variables.contains(start_.entry().at(axis).number) && !isGivenAtStart(axis))
      axes += fmt::format("{}{}..", axes.empty() ? "" : " ", letterOf(axis));
  if (!axes.empty())
    return fmt::format("the start position of the tool is unknown; state it with `@START {}`", axes);
  for (const auto *shifts : {&start_.entry().local, &start_.entry().shift})
    if (std::ranges::any_of(*shifts, [&](const SymbolicValue &shift) { return variables.contains(shift.number); }))
      return "a shift of G52 or G92 may be active at the start; `@OFFSET G54 X.. Y.. Z..` says where the zero point "
             "lies, "
             "and that none is";
  const Dialect &dialect = context_.subject.dialect();
  const ModalTable modes(dialect);
  for (std::size_t group = 0; group < kModalGroups; ++group)
    if (variables.contains(start_.entry().codes[group].index) && !modes.group(group).codes.empty()) {
      const Code &code = *modes.group(group).codes.front();
      return fmt::format("the modal code of the group of G{:02} at the start is unknown; state it with `@MODAL`",
                         code.tenths / 10);
    }
  for (const auto &[variable, value] : start_.interpretation().entryValues())
    if (const auto clause =
            variables.contains(value.number) && !isStated(*context_.subject.contract(), dialect, variable)
                ? setUpClauseOf(dialect, variable)
                : std::nullopt)
      return fmt::format("what #{} holds is not known well enough; state it with `{}`", variable, *clause);
  const auto isOpen = [&](const SymbolicValue &zero) { return !smt::variablesOf(start_.store(), zero.number).empty(); };
  if (std::ranges::any_of(move.point.zero, isOpen) && namesAdditionalOffset(context_.subject.file()))
    return "where the zero point lies is not known: by the P of an additional work offset (G54.1, G154), or by a write "
           "that is not followed";
  return "neither a proof nor a counterexample was found";
}

/// The movements that a rule speaks of, by block, in the order in which they are met.
std::vector<std::pair<Place, Moves>> groupsOf(const ProofContext &context, const SpaceRule &rule) {
  std::vector<std::pair<Place, Moves>> groups;
  std::map<Place, std::size_t> known;
  const auto groupOf = [&](Place own) -> Moves & {
    const auto [group, isNew] = known.try_emplace(own, groups.size());
    return isNew ? groups.emplace_back(own, Moves{}).second : groups[group->second].second;
  };
  for (const MoveInstance &move : context.found.moves)
    if (context.start.space().concerns(rule, move))
      groupOf(move.own).push_back(&move);
  for (const UnmodelledCall &call : context.found.unmodelledCalls)
    groupOf(call.own);
  if (groups.empty() && context.found.incomplete)
    groupOf(context.subject.head());
  return groups;
}

} // namespace

void settleSpace(const ProofContext &context, SettledRows &into) {
  if (!context.subject.contract() || !hasSpaceClause(*context.subject.contract()))
    return;
  SpaceProver prover(context);
  for (const SpaceRule &rule : context.start.space().rules())
    if (context.subject.wants(rule.kind))
      for (const auto &[own, moves] : groupsOf(context, rule)) {
        into.rows.push_back(prover.row(rule, own, moves));
        into.denials.push_back(
            {into.rows.back(),
             [&rule, own = own](const ProofContext &judged) { return SpaceRuns(judged, rule, own).violation(); },
             [&rule, own = own](const ProofContext &judged, Witness witness) {
               return SpaceRuns(judged, rule, own).located(std::move(witness));
             }});
      }
}

} // namespace feedhold::prove
