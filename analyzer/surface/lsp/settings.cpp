#include "surface/lsp/settings.h"

#include <fmt/format.h>

namespace feedhold::lsp {

SettingsRead readSettings(const Json &json, Settings before) {
  SettingsRead read{before, std::nullopt};
  if (!json.is_object())
    return read;
  if (json.contains("feedhold"))
    return readSettings(json["feedhold"], before);
  const auto proofs = json.find("proofs");
  if (proofs == json.end())
    return read;
  if (*proofs == "off")
    read.settings.proofs = Settings::Proofs::Off;
  else if (*proofs == "onSave")
    read.settings.proofs = Settings::Proofs::OnSave;
  else if (*proofs == "onType")
    read.settings.proofs = Settings::Proofs::OnType;
  else
    read.complaint = fmt::format("the setting `proofs` is {}; it must be \"off\", \"onSave\" or \"onType\"",
                                 proofs->dump(-1, ' ', false, Json::error_handler_t::replace));
  return read;
}

} // namespace feedhold::lsp
