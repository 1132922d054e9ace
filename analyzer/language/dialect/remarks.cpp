#include "language/dialect/remarks.h"

#include "base/support/text.h"
#include "language/dialect/comment_signals.h"
#include "language/dialect/line_signals.h"

#include <algorithm>
#include <cstddef>

namespace feedhold {
namespace {

constexpr std::size_t kRemarkSample = std::size_t{256} * 1024;

/// What stands behind the first `;` that is in no comment; empty: nothing.
std::string_view behindSemicolon(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == ';')
      return trimmed(line.substr(i + 1));
    if (line[i] == '(')
      i += commentLength(line.substr(i)) - 1;
  }
  return "";
}

} // namespace

bool isSimulatorDirective(std::string_view line) {
  constexpr std::string_view kNames[] = {"BILLET", "TOOLDEF", "EDGEMOVE", "CLEAR", "STEP"};
  if (!line.starts_with('['))
    return false;
  const std::string_view body = trimmed(line.substr(1));
  return std::any_of(std::begin(kNames), std::end(kNames), [body](std::string_view name) {
    return beginsUpper(body, name) && (body.size() == name.size() || !isLetter(body[name.size()]));
  });
}

bool hasSemicolonRemarks(std::string_view text) {
  TextScan behind;
  text = text.substr(0, kRemarkSample);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    if (const std::string_view rest = behindSemicolon(text.substr(0, end)); !rest.empty() && rest.front() != ';')
      scanLine(rest, behind);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  // Program text behind `;` is a block of its own, or one that was taken out.
  return behind.otherLines > 0 && behind.otherLines * 2 >= behind.programLines;
}

} // namespace feedhold
