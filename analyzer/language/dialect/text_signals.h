// Features of a text that tell which control, or which language, it was written for.  One linear scan counts them all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace feedhold {

enum class TextSignal : std::uint8_t {
#define SIGNAL(kind, description) kind,
#include "language/dialect/text_signals.def"
};

constexpr std::size_t kTextSignalCount = 0
#define SIGNAL(kind, description) +1 // NOLINT(bugprone-macro-parentheses): a term of the sum
#include "language/dialect/text_signals.def"
    ;

std::string_view descriptionOf(TextSignal signal);

struct TextScan {
  std::array<std::uint32_t, kTextSignalCount> counts{};
  std::uint32_t programLines = 0; // made of NC words and macro words alone
  std::uint32_t signalLines = 0;  // hold some signal, and something else that is not understood
  std::uint32_t otherLines = 0;   // prose, another format, another language
  std::uint32_t codeLines = 0;    // hold a G or M code: tables of tools and of offsets have none
  std::pair<std::uint32_t, std::uint32_t> contour = {0, 0}; // P and Q of the last turning cycle
  bool isMarkup = false; // Markdown, HTML, JSON, source code: by its name or its first bytes
  bool isBinary = false;

  std::uint32_t count(TextSignal signal) const { return counts[static_cast<std::size_t>(signal)]; }
};

/// Whether the extension is one of a format that holds programs at most as quotations: documents, source code, data.
bool namesOtherFormat(std::string_view path);

/// `path` gives the file's name; it may be empty.
TextScan scanText(std::string_view text, std::string_view path);

} // namespace feedhold
