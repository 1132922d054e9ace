#include "findings/session/baseline.h"

#include "base/source/path_text.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

/// Without the message: it is worded anew by each version of the program.
auto keyOf(const KnownFinding &finding) { return std::tie(finding.path, finding.rule, finding.fingerprint); }
auto keyOf(const KnownObligation &obligation) {
  return std::tie(obligation.path, obligation.id, obligation.kind, obligation.verdict);
}

} // namespace

bool operator==(const KnownFinding &a, const KnownFinding &b) { return keyOf(a) == keyOf(b); }
bool operator<(const KnownFinding &a, const KnownFinding &b) { return keyOf(a) < keyOf(b); }
bool operator==(const KnownObligation &a, const KnownObligation &b) { return keyOf(a) == keyOf(b); }
bool operator<(const KnownObligation &a, const KnownObligation &b) { return keyOf(a) < keyOf(b); }

namespace {

std::string pathFrom(const fs::path &folder, const std::string &shown) {
  return pathText(normalPath(absolutePath(shown)).lexically_relative(folder));
}

/// Which entries a run speaks of.
class Reach {
public:
  Reach(const CheckResult &result, const BaselineScope &scope) : scope_(scope) {
    for (const CheckedFile &file : result.files) {
      if (file.isOnlyCalled)
        continue;
      paths_.insert(pathFrom(scope.folder, file.path));
      for (const std::string &sidecar : file.sidecars)
        paths_.insert(pathFrom(scope.folder, sidecar));
    }
  }
  Reach(const ProofsResult &result, const BaselineScope &scope) : scope_(scope) {
    for (const ProvedFile &file : result.files)
      paths_.insert(pathFrom(scope.folder, file.file().shown));
    for (const PathProblem &problem : result.errors) // some of its programs may be left out
      paths_.erase(pathFrom(scope.folder, problem.path));
  }

  bool holds(const KnownFinding &entry) const {
    return holdsPath(entry.path) && std::any_of(scope_.rules.begin(), scope_.rules.end(),
                                                [&](const Rule *rule) { return hasName(rule->info, entry.rule); });
  }
  bool holds(const KnownObligation &entry) const {
    return holdsPath(entry.path) &&
           (scope_.kinds.empty() || std::any_of(scope_.kinds.begin(), scope_.kinds.end(),
                                                [&](auto kind) { return prove::nameOf(kind) == entry.kind; }));
  }

private:
  bool holdsPath(const std::string &path) const {
    std::error_code error;
    return paths_.contains(path) || (!fs::exists(scope_.folder / path, error) && !error);
  }

  const BaselineScope &scope_;
  std::set<std::string> paths_;
};

/// The entries of a baseline, and which of them a run has met.
template <typename Entry> class Meeting {
public:
  explicit Meeting(const std::vector<Entry> &entries) : entries_(entries), isMet_(entries.size()) {}

  bool meet(const Entry &entry) {
    const auto found = std::lower_bound(entries_.begin(), entries_.end(), entry);
    if (found == entries_.end() || *found != entry)
      return false;
    isMet_[static_cast<std::size_t>(found - entries_.begin())] = true;
    return true;
  }

  std::vector<Entry> gone(const Reach &reach) const {
    std::vector<Entry> gone;
    for (std::size_t i = 0; i < entries_.size(); ++i)
      if (!isMet_[i] && reach.holds(entries_[i]))
        gone.push_back(entries_[i]);
    return gone;
  }

private:
  const std::vector<Entry> &entries_;
  std::vector<bool> isMet_;
};

KnownFinding entryOf(const Finding &finding, const std::string &path) {
  return {path, std::string(finding.rule->name), finding.fingerprint, finding.diagnostic.message};
}

KnownObligation entryOf(const prove::Obligation &obligation, const std::string &path) {
  return {path, obligation.id, std::string(nameOf(obligation.kind)), obligation.verdict.kind()};
}

bool isOpen(const prove::Obligation &obligation) {
  return obligation.verdict == prove::Verdict::Refuted || obligation.verdict == prove::Verdict::Unknown;
}

bool isKnown(const prove::Obligation &obligation, const std::string &path, Meeting<KnownObligation> &meeting) {
  if (!isOpen(obligation))
    return false;
  KnownObligation entry = entryOf(obligation, path);
  if (meeting.meet(entry))
    return true;
  if (entry.verdict != prove::Verdict::Unknown)
    return false;
  entry.verdict = prove::Verdict::Refuted;
  return meeting.meet(entry);
}

template <typename Entry>
std::vector<Entry> replaced(const std::vector<Entry> &old, std::vector<Entry> current, const Reach &reach) {
  for (const Entry &entry : old)
    if (!reach.holds(entry))
      current.push_back(entry);
  std::stable_sort(current.begin(), current.end());
  current.erase(std::unique(current.begin(), current.end()), current.end());
  return current;
}

} // namespace

NewFindings withoutKnown(CheckResult result, const Baseline &baseline, const BaselineScope &scope) {
  Meeting<KnownFinding> meeting(baseline.findings);
  NewFindings found{std::move(result), 0, {}};
  for (CheckedFile &file : found.result.files) {
    const std::string path = pathFrom(scope.folder, file.path);
    found.hidden += std::erase_if(file.findings, [&](const Finding &finding) {
      return !finding.suppressed && meeting.meet(entryOf(finding, path));
    });
  }
  found.gone = meeting.gone(Reach(found.result, scope));
  return found;
}

NewVerdicts withoutKnown(ProofsResult result, const Baseline &baseline, const BaselineScope &scope) {
  Meeting<KnownObligation> meeting(baseline.obligations);
  NewVerdicts found{std::move(result), 0, {}};
  for (ProvedFile &file : found.result.files) {
    const std::string path = pathFrom(scope.folder, file.file().shown);
    for (ProvedProgram &program : file.programs)
      found.hidden += std::erase_if(program.proof.obligations, [&](const prove::Obligation &obligation) {
        return isKnown(obligation, path, meeting);
      });
  }
  found.gone = meeting.gone(Reach(found.result, scope));
  return found;
}

Baseline updated(const Baseline &baseline, const CheckResult &result, const BaselineScope &scope) {
  std::vector<KnownFinding> current;
  for (const CheckedFile &file : result.files)
    for (const Finding &finding : file.findings)
      if (!finding.suppressed)
        current.push_back(entryOf(finding, pathFrom(scope.folder, file.path)));
  return {replaced(baseline.findings, std::move(current), Reach(result, scope)), baseline.obligations};
}

Baseline updated(const Baseline &baseline, const ProofsResult &result, const BaselineScope &scope) {
  std::vector<KnownObligation> current;
  for (const ProvedFile &file : result.files)
    for (const ProvedProgram &program : file.programs)
      for (const prove::Obligation &obligation : program.proof.obligations)
        if (isOpen(obligation))
          current.push_back(entryOf(obligation, pathFrom(scope.folder, file.file().shown)));
  return {baseline.findings, replaced(baseline.obligations, std::move(current), Reach(result, scope))};
}

} // namespace feedhold
