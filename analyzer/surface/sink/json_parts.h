// What the JSON outputs have in common.  Internal to sink/.
#pragma once

#include "base/diag/diagnostic.h"
#include "base/source/source_file.h"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace feedhold::json {

using Json = nlohmann::ordered_json;

/// `line`, `column`, `endLine`, `endColumn`
Json placeOf(const SourceFile &source, Span span);
/// The whole on one line, and over several lines with a line end behind it.  Bytes that are not UTF-8 become U+FFFD.
std::string compactText(const Json &value);
std::string documentText(const Json &document);

/// What of the start of a run is not as after power-on, or not usual: modal codes and words, coordinates by axis, and
/// settings of the machine.
Json startToJson(const std::vector<std::string> &modal, const std::vector<std::pair<char, double>> &place,
                 const std::vector<std::pair<std::string, bool>> &settings);

Json fixToJson(const FixIt &fix, const SourceFile &source);

} // namespace feedhold::json
