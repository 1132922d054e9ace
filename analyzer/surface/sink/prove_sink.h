// Verdicts of proofs as text, JSON (docs/schemas/prove.schema.json) or SARIF.  Files come by path, programs as they
// stand in them.
#pragma once

#include "findings/session/proofs.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace feedhold {

enum class ShowMethods { No, Yes };

/// All that a writer may look at.
struct ProveReport {
  const ProofsResult &result;
  std::string_view version = {};   // of the program
  std::filesystem::path root = {}; // absolute folder that paths in SARIF are relative to
  int exitCode = 0;
  std::string readingOptions = {};    // options of the command line that a replay of a witness needs, too
  std::string arithmetic = "control"; // or `exact`: in which claims were proved
  ShowMethods showMethods = ShowMethods::No;
  bool colour = false;
};

/// For people: of each program the verdicts, what is refuted first, with the calls that show it.
std::string writeProveText(const ProveReport &report);
std::string writeProveJson(const ProveReport &report);
std::string writeProveSarif(const ProveReport &report);
/// For people, behind the text: how many of what.
std::string proveSummary(const ProveReport &report);
/// Verdicts that a run contradicts, and the calls to report; empty: there are none.
std::string defectsText(const ProveReport &report);
/// The verdicts of each kind of obligation, and what each method has found at what cost.
std::string proveStatistics(const ProveReport &report);

} // namespace feedhold
