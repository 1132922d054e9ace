// Workspace: the open documents with all that is known of them, and how they are read.
#pragma once

#include "findings/project/file_store.h"
#include "surface/lsp/event_queue.h"
#include "surface/lsp/feature.h"
#include "surface/lsp/published_diagnostics.h"
#include "surface/lsp/settings.h"

#include <map>
#include <set>

namespace feedhold::lsp {

inline constexpr std::string_view kContractExtension = ".contract";

/// The text of `stamp` after all safe repairs.
struct FixedText {
  std::uint64_t stamp;
  std::string text;
};

struct OpenDocument {
  Document document;
  std::uint64_t stamp = 0; // another one after each change of the text or of what it depends on

  std::vector<PublishedDiagnostic> quick;  // found without following the flow, in the text in hand
  std::vector<PublishedDiagnostic> denied; // of `quick`, what is not so when the other files of the folder are known
  std::vector<PublishedDiagnostic>
      flow; // what else is found; those of an older text move with it, as those of `denied`
  std::vector<PublishedDiagnostic> proofs; // likewise
  bool isFlowKnown = false;                // `flow` is of the text in hand
  std::map<std::string, Json> others;      // diagnostics for further files, by their URIs

  std::shared_ptr<const Project> programs;               // of the text in hand; null: not read yet
  std::shared_ptr<Flow> kept = std::make_shared<Flow>(); // of `programs`, once it has been asked for
  std::shared_ptr<const std::vector<DocumentProof>> verdicts;
  std::shared_ptr<const ProofsResult> proved; // what they come from
  std::optional<FixedText> fixed;             // made when it was asked for

  std::optional<Clock::time_point> quickDue;
  std::optional<Clock::time_point> flowDue;
  bool isFlowDueForOthers = false; // it is only due since another document is another one
  std::optional<Clock::time_point> proofsDue;

  bool isContract() const { return document.path.extension() == kContractExtension; }
};

/// What to look at for the findings of documents, and on which files they may come out.
struct FlowScope {
  CheckOptions alone; // of one document
  /// In the folder of the workspace: findings on these documents, with all its other files there to be called.
  std::optional<CheckOptions> whole = {};
  /// The folder takes long, so that those of the document alone come first.
  bool isLarge = false;
};

class Workspace {
public:
  explicit Workspace(KnownNames known) : known_(known) {}

  OpenDocument &add(Document document);
  void remove(const std::string &uri);
  OpenDocument *find(const std::string &uri);
  std::map<std::string, OpenDocument> &documents() { return documents_; }
  const std::map<std::string, OpenDocument> &documents() const { return documents_; }

  /// The text of the document is another one: `changes` lead to it.
  void textChanged(OpenDocument &changed, const std::vector<TextChange> &changes);
  /// A file on disk is another one, or the configuration: everything is read anew.
  void surroundingsChanged();

  /// How `check` and `prove` read it.  No path in it: there is nothing to read.
  CheckOptions optionsFor(const OpenDocument &document) const;
  /// How `check` of the folder of the workspace reads it, if it is in one.
  FlowScope scopeOf(const OpenDocument &document);
  /// The innermost folder of the workspace around it; empty: none.
  std::filesystem::path rootOf(const OpenDocument &document) const;
  /// Which file of a result it is.
  static std::string nameIn(const OpenDocument &document, const CheckOptions &options);
  /// The programs that may be meant by a file with contracts: those of its name, else all of its folder.
  static std::vector<std::string> programsBeside(const std::filesystem::path &contract);
  /// Null: it is no program.
  std::shared_ptr<const Project> programsOf(OpenDocument &document);
  View viewOf(OpenDocument &document);
  std::string uriOf(const std::filesystem::path &path) const { return uris_->of(path); }

  PositionEncoding encoding = PositionEncoding::Utf16;
  std::vector<std::filesystem::path> folders;

private:
  void textsChanged();
  std::size_t filesBelow(const std::filesystem::path &root);

  KnownNames known_;
  FileStore store_{FileStore::Lifetime::Server};
  std::map<std::filesystem::path, std::size_t> filesBelow_; // roots: only about how many matters
  std::map<std::string, OpenDocument> documents_;           // by URI
  std::shared_ptr<const OpenTexts> texts_ = std::make_shared<const OpenTexts>();
  std::shared_ptr<const OpenUris> uris_ = std::make_shared<const OpenUris>();
  std::uint64_t lastStamp_ = 0;
};

} // namespace feedhold::lsp
