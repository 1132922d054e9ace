// SeverityCounts: how many findings of each severity, and the words for it.  Internal to sink/.
#pragma once

#include "base/diag/diagnostic.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

/// "1 file", "2 files".
inline std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

class SeverityCounts {
public:
  void add(Severity severity) { ++counts_[static_cast<std::size_t>(severity)]; }
  std::size_t of(Severity severity) const { return counts_[static_cast<std::size_t>(severity)]; }
  std::size_t all() const { return counts_[0] + counts_[1] + counts_[2]; }

  /// "2 errors, 1 warning, 3 info"; "no findings".
  std::string inWords() const {
    std::vector<std::string> parts;
    for (const Severity severity : {Severity::Error, Severity::Warning, Severity::Info})
      if (of(severity) != 0)
        parts.push_back(severity == Severity::Info ? fmt::format("{} info", of(severity))
                                                   : counted(of(severity), nameOf(severity)));
    return parts.empty() ? "no findings" : fmt::format("{}", fmt::join(parts, ", "));
  }

private:
  std::array<std::size_t, 3> counts_{};
};

} // namespace feedhold
