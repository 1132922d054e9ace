// Workspace: the open documents with all that is known of them, and how they are read.
#pragma once

#include "surface/lsp/event_queue.h"
#include "surface/lsp/feature.h"
#include "surface/lsp/remarks.h"
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

  std::vector<Remark> quick;    // found without following the flow, in the text in hand
  std::vector<Remark> flow;     // what else is found; those of an older text move with it
  std::vector<Remark> proofs;   // likewise
  bool isFlowKnown = false;     // `flow` is of the text in hand
  std::set<std::string> others; // URIs of further files on which something is published for it

  std::shared_ptr<const LoadedPrograms> programs; // of the text in hand; null: not read yet
  std::shared_ptr<const std::vector<DocumentProof>> verdicts;
  std::shared_ptr<const ProofsResult> proved; // what they come from
  std::optional<FixedText> fixed;             // made when it was asked for

  std::optional<Clock::time_point> quickDue;
  std::optional<Clock::time_point> flowDue;
  std::optional<Clock::time_point> proofsDue;

  bool isContract() const { return document.path.extension() == kContractExtension; }
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

  /// How `check` and `prove` read it.
  CheckOptions optionsFor(const OpenDocument &document) const;
  /// The programs that may be meant by a file with contracts: those of its name, else all of its folder.
  static std::vector<std::string> programsBeside(const std::filesystem::path &contract);
  /// Null: it is no program.
  std::shared_ptr<const LoadedPrograms> programsOf(OpenDocument &document) const;
  View viewOf(OpenDocument &document) const;
  std::string uriOf(const std::filesystem::path &path) const;

  PositionEncoding encoding = PositionEncoding::Utf16;
  std::vector<std::filesystem::path> folders;

private:
  void textsChanged();

  KnownNames known_;
  std::map<std::string, OpenDocument> documents_; // by URI
  std::shared_ptr<const OpenTexts> texts_ = std::make_shared<const OpenTexts>();
  std::uint64_t lastStamp_ = 0;
};

} // namespace feedhold::lsp
