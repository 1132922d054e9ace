// The part of the scan that reads one line; text_signals.cpp feeds it.
#pragma once

#include "language/dialect/text_signals.h"

#include <string_view>

namespace feedhold {

/// Counts the signals of one line (without its end) and sorts the line into one of the counters of `scan`.
void scanLine(std::string_view line, TextScan &scan);

} // namespace feedhold
