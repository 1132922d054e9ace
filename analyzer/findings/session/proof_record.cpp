#include "findings/session/proof_record.h"

#include "base/support/match.h"
#include "base/support/record.h"

namespace feedhold {

using prove::Obligation;
using prove::ProgramProof;

namespace {

constexpr std::uint64_t kObligationKinds = 0
#define OBLIGATION(kind, name) +1
#include "proof/obligation/obligation_kinds.def"
    ;
constexpr std::uint64_t kAlarmKinds = 0
#define ALARM(kind, meaning) +1
#include "language/dialect/alarms.def"
    ;

/// A record that names places of programs.
class Writer : public RecordWriter {
public:
  explicit Writer(bool keepsEvidence) : keepsEvidence_(keepsEvidence) {}

  bool keepsEvidence() const { return keepsEvidence_; }
  void place(Place place) {
    number(place.file.index());
    number(place.node.index());
  }
  void span(Span span) {
    number(span.begin);
    number(span.end);
  }

private:
  bool keepsEvidence_;
};

class Reader : public RecordReader {
public:
  Reader(std::string_view bytes, const ProgramSet &programs) : RecordReader(bytes), programs_(programs) {}

  Place place() {
    const FileId file(numberUpTo(programs_.size() - 1));
    return {file, NodeId(numberUpTo(programs_.file(file).cfg.nodes.size()))};
  }
  Span span(Place place) {
    const std::uint64_t size = programs_.file(place.file).source->text().size();
    const auto begin = static_cast<std::uint32_t>(numberUpTo(size));
    return {begin, static_cast<std::uint32_t>(numberUpTo(size))};
  }

private:
  const ProgramSet &programs_;
};

void write(Writer &writer, const GivenStart &start) {
  writer.number(start.codes.size());
  for (const auto &[group, code] : start.codes) {
    writer.number(group);
    writer.number(code);
  }
  writer.number(start.words.size());
  for (const auto &[letter, number] : start.words) {
    writer.number(indexOfModalWord(letter));
    writer.real(number);
  }
  writer.number(start.place.size());
  for (const auto &[axis, coordinate] : start.place) {
    writer.number(indexOf(axis));
    writer.real(coordinate);
  }
  writer.number(start.settings.size());
  for (const auto &[setting, isOn] : start.settings) {
    writer.number(setting);
    writer.number(isOn ? 1 : 0);
  }
}

GivenStart readStart(Reader &reader) {
  GivenStart start;
  for (std::uint64_t left = reader.count(); left > 0 && !reader.hasFailed(); --left) {
    const auto group = static_cast<std::uint8_t>(reader.numberUpTo(kModalGroups - 1));
    start.codes.emplace_back(group, static_cast<std::uint8_t>(reader.numberUpTo(63)));
  }
  for (std::uint64_t left = reader.count(); left > 0 && !reader.hasFailed(); --left) {
    const char letter = kModalWords[reader.numberUpTo(kModalWords.size() - 1)];
    start.words.emplace_back(letter, reader.real());
  }
  for (std::uint64_t left = reader.count(); left > 0 && !reader.hasFailed(); --left) {
    const Axis axis = kAllAxes[reader.numberUpTo(kAxisCount - 1)];
    start.place.emplace_back(axis, reader.real());
  }
  for (std::uint64_t left = reader.count(); left > 0 && !reader.hasFailed(); --left) {
    const auto setting = static_cast<SwitchId>(reader.numberUpTo(switchNames().size() - 1));
    start.settings.emplace_back(setting, reader.numberUpTo(1) != 0);
  }
  return start;
}

void write(Writer &writer, const prove::Witness &witness) {
  writer.number(witness.variables.entries().size());
  for (const auto &[variable, value] : witness.variables.entries()) {
    writer.number(variable);
    writer.number(value.vacant ? 1 : 0);
    writer.real(value.number);
  }
  writer.number(witness.variables.readings.entries().size());
  for (const auto &[variable, script] : witness.variables.readings.entries()) {
    writer.number(variable);
    writer.number(script.size());
    for (const double reading : script)
      writer.real(reading);
  }
  write(writer, witness.variables.start);
  writer.number(static_cast<std::uint64_t>(witness.end));
  writer.text(witness.happened);
  writer.optional(witness.gouge, [&](const prove::GougeAt &gouge) {
    writer.place(gouge.place);
    for (const double coordinate : gouge.at)
      writer.real(coordinate);
    writer.real(gouge.depth);
  });
  writer.number(witness.returning.size());
  for (const std::string &name : witness.returning)
    writer.text(name);
}

prove::Witness readWitness(Reader &reader) {
  prove::Witness witness{};
  for (std::uint64_t left = reader.count(); left > 0 && !reader.hasFailed(); --left) {
    const auto variable = static_cast<std::uint32_t>(reader.number());
    const bool vacant = reader.isPresent();
    witness.variables.set(variable, {vacant, reader.real()});
  }
  for (std::uint64_t left = reader.count(); left > 0 && !reader.hasFailed(); --left) {
    const auto variable = static_cast<std::uint32_t>(reader.number());
    std::vector<double> script;
    for (std::uint64_t readings = reader.count(); readings > 0 && !reader.hasFailed(); --readings)
      script.push_back(reader.real());
    witness.variables.readings.set(variable, std::move(script));
  }
  witness.variables.start = readStart(reader);
  witness.end = reader.upTo(RunEnd::Unmodelled);
  witness.happened = reader.text();
  if (reader.isPresent()) {
    prove::GougeAt gouge{.place = reader.place(), .at = {}, .depth = 0};
    for (double &coordinate : gouge.at)
      coordinate = reader.real();
    gouge.depth = reader.real();
    witness.gouge = gouge;
  }
  for (std::uint64_t left = reader.count(); left > 0 && !reader.hasFailed(); --left)
    witness.returning.emplace_back(reader.text());
  return witness;
}

void write(Writer &writer, const FixIt &fix) {
  writer.number(static_cast<std::uint64_t>(fix.safety));
  writer.text(fix.title);
  writer.number(fix.edits.size());
  for (const Edit &edit : fix.edits) {
    writer.span(edit.span);
    writer.text(edit.replacement);
  }
}

/// `place`: somewhere in the file that it changes.
FixIt readFix(Reader &reader, Place place) {
  FixIt fix{.safety = reader.upTo(FixSafety::NeedsReview), .title = std::string(reader.text()), .edits = {}};
  for (std::uint64_t left = reader.count(); left > 0 && !reader.hasFailed(); --left) {
    const Span span = reader.span(place);
    fix.edits.push_back({span, std::string(reader.text())});
  }
  return fix;
}

void write(Writer &writer, const prove::Guard &guard) {
  const auto &[conditions, clause, fix, exactOnly] = guard;
  writer.number(conditions.size());
  for (const std::string &condition : conditions)
    writer.text(condition);
  writer.text(clause);
  writer.optional(fix, [&](const FixIt &value) { write(writer, value); });
  writer.number(exactOnly ? 1 : 0);
}

prove::Guard readGuard(Reader &reader, Place place) {
  prove::Guard guard;
  for (std::uint64_t left = reader.count(); left > 0 && !reader.hasFailed(); --left)
    guard.conditions.emplace_back(reader.text());
  guard.clause = reader.text();
  if (reader.isPresent())
    guard.fix = readFix(reader, place);
  guard.exactOnly = reader.number() != 0;
  return guard;
}

void write(Writer &writer, const prove::Proved &proved) {
  writer.number(static_cast<std::uint64_t>(proved.grade));
  writer.number(proved.evidence.index());
  match(
      proved.evidence,
      [&](const prove::CertificateEvidence &evidence) {
        writer.text(evidence.claim);
        writer.text(evidence.certificate);
      },
      [&](const prove::SolverEvidence &evidence) {
        writer.text(evidence.smtlib);
        writer.list(evidence.solvers, [&](const std::string &solver) { writer.text(solver); });
      });
}

prove::Outcome readOutcome(Reader &reader) {
  prove::Proved proved{.grade = reader.upTo(prove::Grade::TwoSolvers), .evidence = prove::CertificateEvidence()};
  if (reader.numberUpTo(1) == 0) {
    const std::string_view claim = reader.text();
    proved.evidence = prove::CertificateEvidence{std::string(claim), std::string(reader.text())};
  } else {
    prove::SolverEvidence evidence{.smtlib = std::string(reader.text()), .solvers = {}};
    reader.list([&] { evidence.solvers.emplace_back(reader.text()); });
    proved.evidence = std::move(evidence);
  }
  prove::Outcome outcome{.answer = std::move(proved), .method = std::string(reader.text())};
  outcome.effort = reader.number();
  return outcome;
}

/// Outcomes that prove nothing are no evidence.
void write(Writer &writer, const std::vector<prove::Outcome> &evidence) {
  std::vector<const prove::Outcome *> kept;
  for (const prove::Outcome &outcome : evidence)
    if (writer.keepsEvidence() && outcome.proved())
      kept.push_back(&outcome);
  writer.list(kept, [&](const prove::Outcome *outcome) {
    write(writer, std::get<prove::Proved>(outcome->answer));
    writer.text(outcome->method);
    writer.number(outcome->effort);
  });
}

void write(Writer &writer, const prove::verdict::Proved &verdict) {
  const auto &[proof, why, bound, margin, exactOnly] = verdict;
  const auto &[grade, method, evidence] = proof;
  writer.number(static_cast<std::uint64_t>(grade));
  writer.text(method);
  write(writer, evidence);
  writer.text(why);
  writer.text(bound);
  writer.optional(margin, [&](double value) { writer.real(value); });
  writer.number(exactOnly ? 1 : 0);
}

prove::verdict::Proved readProved(Reader &reader) {
  prove::verdict::Proved verdict;
  verdict.proof.grade = reader.upTo(prove::Grade::TwoSolvers);
  verdict.proof.method = reader.text();
  reader.list([&] { verdict.proof.evidence.push_back(readOutcome(reader)); });
  verdict.why = reader.text();
  verdict.bound = reader.text();
  if (reader.isPresent())
    verdict.margin = reader.real();
  verdict.exactOnly = reader.isPresent();
  return verdict;
}

void write(Writer &writer, const prove::verdict::Refuted &verdict) {
  const auto &[shownBy, guard] = verdict;
  writer.number(shownBy.index());
  match(
      shownBy, [&](const prove::Witness &witness) { write(writer, witness); },
      [&](const prove::verdict::Refuted::NoCall &none) { writer.text(none.reason); });
  writer.optional(guard, [&](const prove::Guard &value) { write(writer, value); });
}

prove::verdict::Refuted readRefuted(Reader &reader, Place place) {
  prove::verdict::Refuted verdict;
  if (reader.numberUpTo(1) == 0)
    verdict.shownBy = readWitness(reader);
  else
    verdict.shownBy = prove::verdict::Refuted::NoCall{std::string(reader.text())};
  if (reader.isPresent())
    verdict.guard = readGuard(reader, place);
  return verdict;
}

void write(Writer &writer, const prove::verdict::Unknown &verdict) {
  const auto &[reason, at, guard] = verdict;
  writer.text(reason);
  writer.optional(at, [&](Place place) { writer.place(place); });
  writer.optional(guard, [&](const prove::Guard &value) { write(writer, value); });
}

prove::verdict::Unknown readUnknown(Reader &reader, Place place) {
  prove::verdict::Unknown verdict;
  verdict.reason = reader.text();
  if (reader.isPresent())
    verdict.at = reader.place();
  if (reader.isPresent())
    verdict.guard = readGuard(reader, place);
  return verdict;
}

void write(Writer &writer, const prove::verdict::Unreachable &verdict) { writer.text(verdict.method); }

prove::Verdict readVerdict(Reader &reader, Place place) {
  switch (reader.upTo(prove::Verdict::Unreachable)) {
  case prove::Verdict::Proved: return readProved(reader);
  case prove::Verdict::Refuted: return readRefuted(reader, place);
  case prove::Verdict::Unknown: return readUnknown(reader, place);
  case prove::Verdict::Unreachable: break;
  }
  return prove::verdict::Unreachable{std::string(reader.text())};
}

void write(Writer &writer, const Obligation &obligation) {
  // Names every member, so that one that is new has to be thought of here.
  const auto &[kind, id, place, span, claim, alarm, verdict, effort, tolerance, returning, promising, unchanged,
               takesFewPasses, offsetIsOfTool] = obligation;
  const auto enumeration = [&](auto value) { writer.number(static_cast<std::uint64_t>(value)); };
  enumeration(kind);
  writer.text(id);
  writer.place(place);
  writer.span(span);
  writer.text(claim);
  writer.optional(alarm, enumeration);
  enumeration(verdict.kind());
  verdict.visit([&](const auto &alternative) { write(writer, alternative); });
  writer.number(effort);
  writer.optional(tolerance, [&](double value) { writer.real(value); });
  writer.number(returning.size());
  for (const std::string &name : returning)
    writer.text(name);
  writer.number(promising.size());
  for (const std::string &name : promising)
    writer.text(name);
  writer.number(unchanged ? 1 : 0);
  writer.number(takesFewPasses ? 1 : 0);
  writer.number(offsetIsOfTool ? 1 : 0);
}

Obligation readObligation(Reader &reader) {
  const auto kind = reader.oneOf<prove::ObligationKind>(kObligationKinds);
  const std::string_view id = reader.text();
  const Place place = reader.place();
  Obligation obligation{.kind = kind, .id = std::string(id), .place = place, .span = reader.span(place), .claim = ""};
  obligation.claim = reader.text();
  if (reader.isPresent())
    obligation.alarm = reader.oneOf<AlarmKind>(kAlarmKinds);
  obligation.verdict = readVerdict(reader, place);
  obligation.effort = reader.number();
  if (reader.isPresent())
    obligation.tolerance = reader.real();
  for (std::uint64_t left = reader.count(); left > 0 && !reader.hasFailed(); --left)
    obligation.returning.emplace_back(reader.text());
  for (std::uint64_t left = reader.count(); left > 0 && !reader.hasFailed(); --left)
    obligation.promising.emplace_back(reader.text());
  obligation.unchanged = reader.numberUpTo(1) == 1;
  obligation.takesFewPasses = reader.numberUpTo(1) == 1;
  obligation.offsetIsOfTool = reader.numberUpTo(1) == 1;
  return obligation;
}

} // namespace

std::string writeProofRecord(const ProgramProof &proof, const ProofSteps *steps) {
  const auto &[obligations, unmodelled, incomplete, contradictions] = proof;
  Writer writer(steps != nullptr);
  writer.list(obligations, [&](const Obligation &obligation) { write(writer, obligation); });
  writer.list(unmodelled, [&](const prove::Unmodelled &each) {
    writer.text(each.reason);
    writer.place(each.place);
    writer.span(each.span);
  });
  writer.optional(incomplete, [&](const std::string &reason) { writer.text(reason); });
  writer.list(contradictions, [&](const prove::Contradiction &each) {
    writer.text(each.id);
    writer.text(each.verdict);
    write(writer, each.run);
  });
  writer.list(steps == nullptr ? ProofSteps() : *steps, [&](const auto &step) {
    writer.text(step.first);
    writer.text(step.second);
  });
  return writer.finish();
}

std::optional<RecordedProof> readProofRecord(std::string_view record, const ProgramSet &programs) {
  Reader reader(record, programs);
  RecordedProof read;
  reader.list([&] { read.proof.obligations.push_back(readObligation(reader)); });
  reader.list([&] {
    const std::string_view reason = reader.text();
    const Place place = reader.place();
    read.proof.unmodelled.push_back({reason, place, reader.span(place)});
  });
  if (reader.isPresent())
    read.proof.incomplete = reader.text();
  reader.list([&] {
    const std::string_view id = reader.text();
    const std::string_view verdict = reader.text();
    read.proof.contradictions.push_back({std::string(id), std::string(verdict), readWitness(reader)});
  });
  reader.list([&] {
    const std::string_view claim = reader.text();
    read.steps.emplace(claim, reader.text());
  });
  return reader.isDone() ? std::optional(std::move(read)) : std::nullopt;
}

} // namespace feedhold
