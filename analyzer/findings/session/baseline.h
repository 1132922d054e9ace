// Baseline: findings and verdicts that were there when a shop began to look; only what is new is reported.
#pragma once

#include "findings/session/proofs.h"
#include "findings/session/result.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace feedhold {

struct KnownFinding {
  std::string path; // from the folder of the baseline, `/` as separator
  std::string rule;
  std::string fingerprint; // 16 hex digits
  std::string message;     // for who reads the baseline

  /// Without the message: it is worded anew by each version of the program.
  friend bool operator==(const KnownFinding &a, const KnownFinding &b);
  friend bool operator<(const KnownFinding &a, const KnownFinding &b);
};

struct KnownObligation {
  std::string path;
  std::string id;
  std::string kind;
  prove::Verdict::Kind verdict; // Refuted or Unknown

  friend bool operator==(const KnownObligation &a, const KnownObligation &b);
  friend bool operator<(const KnownObligation &a, const KnownObligation &b);
};

/// Both sorted.
struct Baseline {
  std::vector<KnownFinding> findings;
  std::vector<KnownObligation> obligations;
};

/// What a run has looked at: an entry about something else is neither confirmed nor gone.
struct BaselineScope {
  std::filesystem::path folder;                  // of the baseline, absolute
  std::span<const Rule *const> rules = {};       // of `check`: those that may have run
  std::vector<prove::ObligationKind> kinds = {}; // of `prove`: those that were proved; empty: all
};

/// A result without what the baseline knows.
struct NewFindings {
  CheckResult result;
  std::size_t hidden = 0;
  std::vector<KnownFinding> gone; // found no longer, or their file is no longer there
};
NewFindings withoutKnown(CheckResult result, const Baseline &baseline, const BaselineScope &scope);

/// What was refuted hides what is unknown now, not the other way round.
struct NewVerdicts {
  ProofsResult result;
  std::size_t hidden = 0;
  std::vector<KnownObligation> gone;
};
NewVerdicts withoutKnown(ProofsResult result, const Baseline &baseline, const BaselineScope &scope);

/// The baseline with what this run has found in place of what it says of the same files and rules.
Baseline updated(const Baseline &baseline, const CheckResult &result, const BaselineScope &scope);
Baseline updated(const Baseline &baseline, const ProofsResult &result, const BaselineScope &scope);

} // namespace feedhold
