// Edits: replacements in the document, in files of its folder and in contracts beside them.
#pragma once

#include "surface/lsp/feature_json.h"

#include <map>

namespace feedhold::lsp {

class Edits {
public:
  explicit Edits(const View &view) : view_(view) {}

  void replace(FileId file, Span span, const std::string &text);
  /// In a text from which the contracts of a file are read.
  void replace(FileId file, ContractSourceId source, Span span, const std::string &text);
  /// `{"changes": ..}`
  Json workspaceEdit() const;

private:
  const View &view_;
  std::map<std::string, std::map<Span, Json>> edits_; // by URI; a place is replaced once
};

} // namespace feedhold::lsp
