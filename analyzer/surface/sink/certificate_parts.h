// The parts of a certificate, each from one step to the next.  Internal to sink/.
#pragma once

#include "surface/sink/certificate.h"
#include "surface/sink/prove_shown.h"

#include <nlohmann/json.hpp>

namespace feedhold::certificate {

/// Members are sorted by name, which makes the text canonical.
using Json = nlohmann::json;

std::string textOf(const Json &document);

/// What every certificate takes for given, numbered.
Json assumptions();

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
Json documentOf(const CertificateInput &input, const Bundle &evidence,
                const std::vector<std::vector<std::vector<ShownRun>>> &runs);

/// The page: a function of the report's other files alone.
std::string pageOf(const std::string &certificate, const Bundle &report);

} // namespace feedhold::certificate
