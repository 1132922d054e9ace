// ANSI colours (ECMA-48, select graphic rendition): error red, warning yellow, info cyan, gutter and second labels
// blue.
#include "base/diag/paint.h"

#include "base/diag/diagnostic.h"
#include "base/support/check.h"

namespace feedhold {

namespace {

constexpr std::string_view kReset = "\x1b[0m";
constexpr std::string_view kBold = "\x1b[1m";
constexpr std::string_view kBoldRed = "\x1b[1;31m";
constexpr std::string_view kBoldYellow = "\x1b[1;33m";
constexpr std::string_view kBoldBlue = "\x1b[1;34m";
constexpr std::string_view kBoldCyan = "\x1b[1;36m";

std::string_view colourOf(std::string_view severity) {
  if (severity == nameOf(Severity::Error))
    return kBoldRed;
  return severity == nameOf(Severity::Warning) ? kBoldYellow : kBoldCyan;
}

} // namespace

Painter::Painter(std::string_view severity, bool colour) : severityCode_(colourOf(severity)), colour_(colour) {}

std::string Painter::line(const StyledLine &pieces) const {
  std::string plain;
  for (const Piece &piece : pieces)
    plain += piece.text;
  std::size_t left = plain.find_last_not_of(' ') + 1;
  std::string result;
  for (const Piece &piece : pieces) {
    const std::string_view text = std::string_view(piece.text).substr(0, left);
    left -= text.size();
    const bool bare = !colour_ || piece.style == Style::Plain || text.empty();
    result += bare ? std::string(text) : std::string(codeOf(piece.style)).append(text).append(kReset);
  }
  return result + '\n';
}

std::string_view Painter::codeOf(Style style) const {
  switch (style) {
  case Style::Plain: return "";
  case Style::Message: return kBold;
  case Style::Gutter:
  case Style::Secondary: return kBoldBlue;
  case Style::Severity: return severityCode_;
  }
  FEEDHOLD_UNREACHABLE("a style without a colour");
}

} // namespace feedhold
