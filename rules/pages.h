// The pages of the rules as text in the program; generated at build time from rules/*/*.md.
#pragma once

#include <cstddef>
#include <string_view>

namespace feedhold::rules {

struct Page {
  std::string_view file; // `missing_equals`
  std::string_view text;
};

extern const Page kPages[];
extern const std::size_t kPageCount;

} // namespace feedhold::rules
