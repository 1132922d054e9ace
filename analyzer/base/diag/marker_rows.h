// The rows below a source line: carets, dashes and the texts of the labels.  Internal to diag/.
#pragma once

#include "base/diag/line_picture.h"
#include "base/diag/paint.h"

#include <string>
#include <vector>

namespace feedhold {

enum class MarkerKind { Secondary, Primary };

struct Marker {
  Columns columns;
  MarkerKind kind;
  std::string text; // printable; may be empty
};

/// The first row has all carets and dashes, and the text of the rightmost marker; the texts of the others follow below,
/// each tied to its marker by a line, from right to left.
std::vector<StyledLine> markerRows(std::vector<Marker> markers);

} // namespace feedhold
