// PublishedDiagnostic: what the server reports on a document, tied to its text, so that it moves with edits.
#pragma once

#include "findings/session/proofs.h"
#include "findings/session/session.h"
#include "surface/lsp/documents.h"

#include <functional>
#include <string>
#include <vector>

namespace feedhold::lsp {

/// Another place to which a diagnostic refers.
struct RelatedPlace {
  std::string uri; // empty: that of the diagnostic
  Span span = {};  // of the same document
  Json range = {}; // of another one
  std::string message;
};

struct PublishedDiagnostic {
  Span span;
  Severity severity;
  std::string code;    // the rule, or the kind of an obligation
  std::string subject; // of an obligation: its id
  std::string message; // with its notes, a line for each
  std::vector<RelatedPlace> related = {};
  std::vector<FixIt> fixes = {};
  std::vector<Json> commands = {}; // of the protocol: what can be done beside fixes
};

/// What publishing needs to know of the server.
struct PublishContext {
  PositionEncoding encoding;
  std::function<std::string(const std::filesystem::path &)> uriOf; // as the client wrote it, if the file is open
  std::function<std::string(std::string_view)> pageOf;             // of a rule: its URI; empty: none
};

/// Of one file of a check; what comments allow is left out.
std::vector<PublishedDiagnostic> diagnosticsOfCheck(std::size_t file, const CheckResult &result,
                                                    const PublishContext &context);

/// What is refuted and what is not known of its programs.
std::vector<PublishedDiagnostic> diagnosticsOfProofs(const ProvedFile &file, const ProofsResult &result,
                                                     const PublishContext &context);

/// The diagnostic after a change of its text; absent when the change touches it.
std::optional<PublishedDiagnostic> moved(const PublishedDiagnostic &published, const TextChange &change);

/// By place, code and message.
struct SplitDiagnostics {
  std::vector<PublishedDiagnostic> known; // are among the others
  std::vector<PublishedDiagnostic> fresh;
};
SplitDiagnostics split(std::vector<PublishedDiagnostic> diagnostics, const std::vector<PublishedDiagnostic> &others);

/// As the protocol has it.
Json diagnosticOf(const PublishedDiagnostic &published, const Places &places, const std::string &uri,
                  const PublishContext &context);

} // namespace feedhold::lsp
