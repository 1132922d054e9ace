// The parts of a certificate, each from one step to the next.  Internal to sink/.
#pragma once

#include "surface/report/release_report.h"
#include "surface/sink/prove_shown.h"

#include <nlohmann/json.hpp>

namespace feedhold::certificate {

/// Members are sorted by name, which makes the text canonical.
using Json = nlohmann::json;

std::string textOf(const Json &document);
Result<Json> readDocument(const Bundle &report);

/// What every certificate takes for given, numbered.
Json assumptions();

/// An alarm of the program that some call raises, and that its contract does not foresee.
struct RaisedAlarm {
  std::optional<std::uint32_t> number = {}; // absent: it is computed
  std::string message = {};                 // what the operator reads
};
/// Of a refuted `alarm-unreachable`.
std::optional<RaisedAlarm> raisedAlarm(const prove::Obligation &obligation, const ProvedFile &file);

/// One or two sentences for who releases the program.
std::string sentenceOf(const ProvedFile &file, const ProvedProgram &program);

/// A run that is shown.
struct ShownRun {
  std::string witnessOf; // an obligation that it refutes; empty: a call that the contract allows
  std::string call;      // as a person reads it
  std::string options;   // of `feedhold plot`, behind the file
  std::string svg;
  std::vector<std::string> notes;
};
/// Of one program: the runs in which the tool goes where it must not, or else one that the contract allows.  Nothing
/// where no axis moves.
std::vector<ShownRun> shownRuns(const ProvedFile &file, const ProvedProgram &program);

/// Without the file, which lies elsewhere for everybody.
std::string optionsBehindFile(const TypedWitness &run, const ProvedFile &file);

/// It names each file of the report but the page by its hash, those of the evidence by their index.  `runs`: by file
/// and program.
Json documentOf(const ReportInput &input, const Bundle &evidence,
                const std::vector<std::vector<std::vector<ShownRun>>> &runs);

/// The page: a function of the report's other files alone.
std::string pageOf(const std::string &certificate, const Bundle &report);

} // namespace feedhold::certificate
