// Answers of the protocol made of our places.
#pragma once

#include "surface/lsp/feature.h"
#include "surface/lsp/feature_uses.h"

namespace feedhold::lsp {

/// The same with all files of its folder: who calls a program is seen from there.
View withFolder(const View &view);
/// The offset of `params.position` in the document.
std::uint32_t offsetOf(const View &view, const Json &params);
/// What stands at `params.position`.
std::optional<SymbolAt> symbolAt(const View &view, const Json &params);
Json rangeOf(const View &view, FileId file, Span span);
/// `{"uri": .., "range": ..}`
Json locationOf(const View &view, FileId file, Span span);
Json locationOf(const View &view, const Use &use);
/// `{"kind": "markdown", "value": ..}`
Json markdown(std::string text);
/// Words of a program or of a person, so that Markdown shows them as they are.
std::string plain(std::string_view text);

/// From its O word up to its last block that the control reads.
Span spanOf(const ProjectFile &file, ProgramId program);
/// The O word, or the first block of a program without one.
Span nameSpanOf(const ProjectFile &file, ProgramId program);

} // namespace feedhold::lsp
