// Causes: findings with one reason, which outputs for people tell once, with the number of places.  Internal to sink/.
#pragma once

#include "surface/sink/sink.h"

#include <vector>

namespace feedhold {

struct FoundPlace {
  const CheckedFile *file;
  const Finding *finding;
};

/// By file and place; the first is shown.  Never empty.
struct Cause {
  std::vector<FoundPlace> places;
};

/// Of the findings that are shown, by their first places.  One cause have findings of one rule that say the same
///  - of one file,
///  - of lines with the same text, in whatever files: a copied block, a common header,
///  - of files in one foreign language,
///  - of files in one folder, if the rule reports what a folder lacks (CauseScope),
/// and rows of a table: kTableRows findings or more of one rule in neighbouring lines, whose messages differ only in
/// the quoted code.
std::vector<Cause> causesOf(const Report &report);
inline constexpr std::size_t kTableRows = 4;

/// "the same in 3 more places: lines 12, 13, 20", with files where there are several; empty for a single place.
std::string otherPlaces(const Cause &cause);

} // namespace feedhold
