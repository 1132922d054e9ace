#include "surface/report/report_html.h"

#include <utility>

namespace feedhold::certificate {

std::string text(const Json &value) { return xml(value.get_ref<const std::string &>()); }

std::string prose(std::string_view words) {
  std::string html;
  bool isCode = false;
  while (!words.empty()) {
    const std::size_t tick = words.find('`');
    html += xml(words.substr(0, tick));
    if (tick == std::string_view::npos)
      break;
    html += isCode ? "</code>" : "<code>";
    isCode = !isCode;
    words.remove_prefix(tick + 1);
  }
  return html + (isCode ? "</code>" : "");
}
std::string prose(const Json &value) { return prose(std::string_view(value.get_ref<const std::string &>())); }

std::string number(const Json &value) {
  return value.is_number_float() ? fmt::format("{:.6g}", value.get<double>())
                                 : std::to_string(value.get<std::uint64_t>());
}

std::string counted(std::uint64_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string anchorOf(const std::string &path, const std::string &program) {
  std::string plain;
  for (const char c : "P-" + path + "-" + program)
    plain +=
        (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' || c == '-' ? c : '_';
  return plain;
}
std::string anchorOf(const Json &file, const Json &program) {
  return anchorOf(file.at("path").get<std::string>(), program.at("name").get<std::string>());
}

Look lookOfClaim(const Json &obligation) {
  const std::string &verdict = obligation.at("verdict").get_ref<const std::string &>();
  if (!obligation.at("alarm").is_null())
    return {"alarms", "!", "alarm"};
  if (verdict == "proved")
    return {"proved", "✓", "proved"};
  if (verdict == "refuted")
    return {"refuted", "✗", "refuted"};
  if (verdict == "unknown")
    return {"unknown", "?", "unknown"};
  return {"unreachable", "–", "unreachable"};
}

Look lookOfStatus(const Json &status) {
  if (status == "ready")
    return {"proved", "✓", "proved"};
  if (status == "refuted")
    return {"refuted", "✗", "refuted"};
  if (status == "alarms")
    return {"alarms", "!", "alarm to decide on"};
  return {"unknown", "?", "not all proved"};
}

std::string badge(const Look &look) {
  return fmt::format("<span class=\"badge {}\">{} {}</span>", look.style, look.sign, look.word);
}

ShownPaths::ShownPaths(const Json &document) {
  bool isFirst = true;
  for (const Json &file : document.at("files")) {
    const std::string &path = file.at("path").get_ref<const std::string &>();
    const std::string folder = path.substr(0, path.rfind('/') + 1);
    if (std::exchange(isFirst, false))
      folder_ = folder;
    while (!folder.starts_with(folder_))
      folder_.erase(folder_.size() < 2 ? 0 : folder_.rfind('/', folder_.size() - 2) + 1);
  }
}

std::string ShownPaths::of(const Json &path) const {
  const std::string &whole = path.get_ref<const std::string &>();
  return xml(whole.starts_with(folder_) ? whole.substr(folder_.size()) : whole);
}

} // namespace feedhold::certificate
