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

std::string compactText(const Json &value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string documentText(const Json &document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json startToJson(const std::vector<std::string> &modal, const std::vector<std::pair<char, double>> &place,
                 const std::vector<std::pair<std::string, bool>> &settings) {
  Json position = Json::object();
  for (const auto &[axis, coordinate] : place)
    position[std::string(1, axis)] = coordinate;
  Json switches = Json::object();
  for (const auto &[name, isOn] : settings)
    switches[name] = isOn;
  return {{"modal", modal}, {"position", std::move(position)}, {"switches", std::move(switches)}};
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
