// Diagnostic: a message about the user's program, as data.
#pragma once

#include "base/source/span.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

enum class Severity { Info, Warning, Error };

std::string_view nameOf(Severity severity);
std::optional<Severity> severityFromName(std::string_view name);

/// A second place that the message speaks of.  `file` absent: the file of the diagnostic itself.
struct Label {
  Span span;
  std::string text;
  std::optional<FileId> file = std::nullopt;
};

struct Edit {
  Span span;               // replaced; empty for an insertion
  std::string replacement; // bytes in the file's own encoding
};

/// Safe: the repaired program does what the control did with the old one, or what the old text can only have meant.
/// NeedsReview: a person must look.
enum class FixSafety { Safe, NeedsReview };

std::string_view nameOf(FixSafety safety);

struct FixIt {
  FixSafety safety = FixSafety::NeedsReview;
  std::string title; // imperative, lower case: "write `=` instead of `-`"
  std::vector<Edit> edits;
};

struct Diagnostic {
  std::string message; // what was seen, shop words, lower case, no full stop, code in backticks
  Span span;
  std::string label = {}; // text beside the primary carets; may be empty
  std::vector<Label> labels = {};
  std::vector<Label> flow =
      {}; // the path that leads to it: the places where something is decided, in the order of execution
  std::vector<std::string> notes = {}; // why it matters on the machine, what to do
  std::vector<FixIt> fixes = {};
};

} // namespace feedhold
