// Settings: what a person chose in the editor.  All that concerns programs is in `feedhold.toml`, so that the editor
// and the command line say the same.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace feedhold::lsp {

using Json = nlohmann::json;

struct Settings {
  /// When the prover runs by itself.
  enum class Proofs : std::uint8_t { Off, OnSave, OnType } proofs = Proofs::OnSave;
};

struct SettingsRead {
  Settings settings;
  std::optional<std::string> complaint; // about a value that does not exist
};

/// `{"proofs": "off" | "onSave" | "onType"}`, with or without `{"feedhold": ..}` around it; what is absent stays as it
/// is in `before`.
SettingsRead readSettings(const Json &json, Settings before);

} // namespace feedhold::lsp
