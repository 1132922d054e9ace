#include "language/dialect/remarks.h"

#include "base/support/text.h"
#include "language/dialect/comment_signals.h"
#include "language/dialect/line_signals.h"
#include "language/dialect/text_keywords.h"

#include <algorithm>
#include <cstddef>

namespace feedhold {
namespace {

constexpr std::size_t kRemarkSample = std::size_t{256} * 1024;

struct Remark {
  std::string_view text; // behind the first `;` that is in no comment; empty: nothing
  bool isWholeLine = false;
};

Remark remarkOf(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == ';')
      return {trimmed(line.substr(i + 1)), trimmed(line.substr(0, i)).empty()};
    if (line[i] == '(')
      i += commentLength(line.substr(i)) - 1;
  }
  return {};
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
  TextScan behind; // code in front of the `;`, or prose
  TextScan lines;  // nothing in front of it
  text = text.substr(0, kRemarkSample);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    if (const Remark remark = remarkOf(text.substr(0, end)); !remark.text.empty() && remark.text.front() != ';')
      scanLine(remark.text, remark.isWholeLine ? lines : behind);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  // Prose may hold a letter or a number that means something: `; size of #2`.  Program text behind `;` is a block of
  // its own, or one that was taken out.  In a text with remarks, a line that begins with `;` was taken out: nobody
  // begins a line by ending a block.
  const std::uint32_t prose = behind.otherLines + behind.signalLines + lines.otherLines + lines.signalLines;
  return prose > 0 && prose * 2 >= behind.programLines;
}

} // namespace feedhold
