// Feature: what a client can ask about a document; one handler file for each.
#pragma once

#include "findings/project/project.h"
#include "proof/prove/prove.h"
#include "surface/lsp/feature_flow.h"
#include "surface/lsp/places.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::lsp {

using Json = nlohmann::json;

/// One program's verdicts, of the text in hand.
struct DocumentProof {
  ProgramId program;
  prove::ProgramProof proof;
};

/// A document as its features see it: read together with its folder.
struct View {
  std::string uri;                                          // as the client wrote it
  std::shared_ptr<const Project> programs;                  // the document is FileId(0)
  std::shared_ptr<const std::vector<DocumentProof>> proofs; // null: not finished for this text
  const KnownNames &known;
  PositionEncoding encoding;
  std::vector<std::filesystem::path> folders; // of the workspace
  std::shared_ptr<const OpenTexts> open = {}; // of all editors
  std::shared_ptr<const OpenUris> uris = std::make_shared<const OpenUris>();
  FileStore *store = nullptr; // of what was loaded before
  std::shared_ptr<Flow> flow = std::make_shared<Flow>();

  const ProjectFile &file() const { return programs->file(FileId(0)); }
  Places places() const { return Places(file().source, encoding); }
  Places places(FileId id) const { return Places(programs->file(id).source, encoding); }
  /// The URI of any of its files; that of an open document as the client wrote it.
  std::string uriOf(FileId id) const;
};

/// A request that is understood and cannot be done safely, with the reason in shop words: answered as RequestFailed.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Answers one kind of request: `params` as the protocol defines them, the result likewise; null where there is
/// nothing. Parameters without the right form are found by the dispatcher, which answers InvalidParams for an exception
/// of nlohmann::json.
using Answer = Json (*)(const View &view, const Json &params);

struct Feature {
  std::string_view method; // "textDocument/hover"
  Answer answer;
};

/// All of them, by method.
std::span<const Feature> features();
/// What `initialize` says about them: parts of ServerCapabilities.
Json featureCapabilities();

} // namespace feedhold::lsp
