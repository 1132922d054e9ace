// The picture of a diagnostic in a terminal: path, line, carets, labels, notes, fixes.
#pragma once

#include "base/diag/diagnostic.h"
#include "base/source/source_file.h"

#include <functional>
#include <string>

namespace feedhold {

struct RenderOptions {
  bool colour = false;
  std::uint32_t tabWidth = 4;
  std::uint32_t maxLineWidth = 160; // a longer source line is shown as a window around its carets
};

/// What the renderer must know beside the diagnostic itself.
struct RenderedHead {
  std::string_view severity; // "error"
  std::string_view rule;     // "missing-equals"
};

/// Ends with a line feed.  Carets are right with tabs, wide and non-ASCII characters; control bytes are shown as
/// Unicode control pictures.  `fileOf` finds the source of labels in other files.
std::string render(const Diagnostic &diagnostic, const RenderedHead &head, const SourceFile &source,
                   const std::function<const SourceFile &(FileId)> &fileOf, const RenderOptions &options);

} // namespace feedhold
