#include "surface/evidence/reading_json.h"

#include "base/source/path_text.h"
#include "proof/obligation/obligation_kinds.h"
#include "surface/sink/prove_shown.h"

#include <fmt/format.h>

namespace feedhold {

using json::Json;

Json readingToJson(const BundleReading &reading, const std::filesystem::path &folder) {
  Json only = Json::array();
  for (const prove::ObligationKind kind : reading.only)
    only.push_back(prove::nameOf(kind));
  const auto &increments = reading.control.incrementSystem;
  const auto &codes = reading.control.gCodeSystem;
  return {{"dialect", reading.control.dialect ? Json(*reading.control.dialect) : Json()},
          {"incrementSystem", increments ? Json(nameOf(*increments)) : Json()},
          {"gCodeSystem", codes ? Json(nameOf(*codes)) : Json()},
          {"isolated", reading.isolated},
          {"config", reading.config ? Json(pathFrom(folder, *reading.config)) : Json()},
          {"only", std::move(only)}};
}

BundleReading readingFrom(const Json &reading, const std::filesystem::path &folder) {
  BundleReading read;
  if (!reading.at("dialect").is_null())
    read.control.dialect = reading.at("dialect").get<std::string>();
  if (const auto increments = reading.find("incrementSystem"); increments != reading.end() && !increments->is_null())
    read.control.incrementSystem = incrementSystemNamed(increments->get<std::string>());
  if (const auto codes = reading.find("gCodeSystem"); codes != reading.end() && !codes->is_null())
    read.control.gCodeSystem = gCodeSystemNamed(codes->get<std::string>());
  read.isolated = reading.at("isolated");
  if (!reading.at("config").is_null())
    read.config = normalPath(folder / reading.at("config").get<std::string>());
  for (const prove::ObligationKind kind : prove::kObligationKinds)
    for (const Json &name : reading.at("only"))
      if (name == prove::nameOf(kind))
        read.only.push_back(kind);
  return read;
}

std::string readingOptions(const BundleReading &reading) {
  std::string text;
  if (reading.control.dialect)
    text += " --dialect " + *reading.control.dialect;
  if (reading.control.incrementSystem)
    text += fmt::format(" --increment-system {}", nameOf(*reading.control.incrementSystem));
  if (reading.control.gCodeSystem)
    text += fmt::format(" --g-code-system {}", nameOf(*reading.control.gCodeSystem));
  if (reading.isolated)
    text += " --isolated";
  else if (reading.config)
    text += " --config " + quotedWord(pathText(*reading.config));
  return text;
}

} // namespace feedhold
