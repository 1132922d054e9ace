#include "surface/sink/json_parts.h"

#include "surface/sink/shown.h"

namespace feedhold::json {

Json placeOf(const SourceFile &source, Span span) {
  const TextRegion region = regionOf(source, span);
  return {{"line", region.begin.line},
          {"column", region.begin.column},
          {"endLine", region.end.line},
          {"endColumn", region.end.column}};
}

Json fixToJson(const FixIt &fix, const SourceFile &source) {
  Json edits = Json::array();
  for (const Edit &edit : fix.edits) {
    Json row = placeOf(source, edit.span);
    row["replacement"] = edit.replacement;
    edits.push_back(std::move(row));
  }
  return {{"title", fix.title}, {"safety", nameOf(fix.safety)}, {"edits", std::move(edits)}};
}

} // namespace feedhold::json
