// Remarks: what is said of a document, tied to its text, so that it follows the text while it is edited.
#pragma once

#include "findings/session/proofs.h"
#include "findings/session/session.h"
#include "surface/lsp/documents.h"

#include <functional>
#include <string>
#include <vector>

namespace feedhold::lsp {

/// Another place that a remark speaks of.
struct RelatedPlace {
  std::string uri; // empty: that of the remark
  Span span = {};  // of the same document
  Json range = {}; // of another one
  std::string message;
};

struct Remark {
  Span span;
  Severity severity;
  std::string code;    // the rule, or the kind of an obligation
  std::string subject; // of an obligation: its id
  std::string message; // with its notes, a line for each
  std::vector<RelatedPlace> related = {};
  std::vector<FixIt> fixes = {};
  std::vector<Json> commands = {}; // of the protocol: what can be done beside fixes
};

/// What the remarks need to know of the server.
struct RemarkContext {
  PositionEncoding encoding;
  std::function<std::string(const std::filesystem::path &)> uriOf; // as the client wrote it, if the file is open
  std::function<std::string(std::string_view)> pageOf;             // of a rule: its URI; empty: none
};

/// Of one file of a check; what comments allow is left out.
std::vector<Remark> remarksOn(std::size_t file, const CheckResult &result, const RemarkContext &context);

/// What is refuted and what is not known of its programs.
std::vector<Remark> remarksOnProofs(const ProvedFile &file, const ProofsResult &result, const RemarkContext &context);

/// The remark after a change of its text; absent when the change touches it.
std::optional<Remark> moved(const Remark &remark, const TextChange &change);

/// By place, code and message.
struct SplitRemarks {
  std::vector<Remark> known; // are among the others
  std::vector<Remark> fresh;
};
SplitRemarks split(std::vector<Remark> remarks, const std::vector<Remark> &others);

/// As the protocol has it.
Json diagnosticOf(const Remark &remark, const Places &places, const std::string &uri, const RemarkContext &context);

} // namespace feedhold::lsp
