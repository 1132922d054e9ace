// Styles of the parts of a rendered diagnostic, and their ANSI colours.  Internal to diag/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

enum class Style { Plain, Message, Gutter, Severity, Secondary };

struct Piece {
  std::string text;
  Style style = Style::Plain;
};

/// One line of output as pieces of one style each.
using StyledLine = std::vector<Piece>;

class Painter {
public:
  /// `severity` decides the colour of Style::Severity; without `colour` every style is plain text.
  Painter(std::string_view severity, bool colour);

  /// The pieces with a line feed; spaces at the end are left out.
  std::string line(const StyledLine &pieces) const;

private:
  std::string_view codeOf(Style style) const;

  std::string_view severityCode_;
  bool colour_;
};

} // namespace feedhold
