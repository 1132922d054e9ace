// What the JSON outputs have in common.  Internal to sink/.
#pragma once

#include "base/diag/diagnostic.h"
#include "base/source/source_file.h"

#include <nlohmann/json.hpp>

namespace feedhold::json {

using Json = nlohmann::ordered_json;

/// `line`, `column`, `endLine`, `endColumn`
Json placeOf(const SourceFile &source, Span span);
Json fixToJson(const FixIt &fix, const SourceFile &source);

} // namespace feedhold::json
