// Repairing: rounds of applying fixes and checking again, then writing.
#include "findings/session/session.h"

#include "base/diag/edits.h"
#include "base/source/write_file.h"
#include "findings/session/analyse.h"

#include <algorithm>
#include <utility>

namespace feedhold {

namespace {

/// One file during the rounds.
struct Repair {
  std::string original;
  std::string previous; // before the last round
  std::size_t errors = 0;
  std::size_t fixes = 0;
  std::size_t lastFixes = 0;
  bool isFrozen = false; // repairing it made things worse
};

std::size_t errorCount(const CheckedFile &file) {
  return static_cast<std::size_t>(std::count_if(file.findings.begin(), file.findings.end(), [](const Finding &finding) {
    return finding.severity == Severity::Error;
  }));
}

/// The first fix of each finding that the kind allows; the others are alternatives to it.
std::vector<FixIt> wantedFixes(const CheckedFile &file, FixKind kind) {
  std::vector<FixIt> wanted;
  for (const Finding &finding : file.findings) {
    if (finding.suppressed || !isReported(finding, file))
      continue;
    const std::vector<FixIt> &fixes = finding.diagnostic.fixes;
    const auto first = std::find_if(fixes.begin(), fixes.end(), [&](const FixIt &candidate) {
      return kind == FixKind::All || candidate.safety == FixSafety::Safe;
    });
    if (first != fixes.end())
      wanted.push_back(*first);
  }
  return wanted;
}

class Repairer {
public:
  Repairer(const CheckOptions &options, FixKind kind, const KnownNames &known)
      : options_(options), kind_(kind), known_(known), workload_(loadWorkload(options, known)),
        repairs_(workload_.items.size()) {}

  FixResult run() {
    std::vector<CheckedFile> files = analyseAll();
    for (std::size_t i = 0; i < repairs_.size(); ++i)
      repairs_[i].errors = errorCount(files[i]);
    for (int round = 0; round < kMostFixRounds && applyAll(files); ++round) {
      files = analyseAll();
      if (takeBackWorse(files))
        files = analyseAll();
    }
    return result(std::move(files));
  }

private:
  std::vector<CheckedFile> analyseAll() const {
    return analyse(workload_.items, known_,
                   {options_.jobs, options_.progress, options_.open, options_.only ? &*options_.only : nullptr})
        .files;
  }

  bool applyAll(const std::vector<CheckedFile> &files) {
    bool changed = false;
    for (std::size_t i = 0; i < repairs_.size(); ++i)
      changed = (!repairs_[i].isFrozen && apply(files[i], i)) || changed;
    return changed;
  }

  bool apply(const CheckedFile &file, std::size_t i) {
    Repair &repair = repairs_[i];
    repair.lastFixes = 0;
    const std::vector<FixIt> fixes = wantedFixes(file, kind_);
    if (fixes.empty())
      return false;
    AppliedEdits applied = applyFixes(file.source.text(), fixes);
    if (applied.text == file.source.text())
      return false;
    repair.previous = std::string(file.source.text());
    if (repair.fixes == 0)
      repair.original = repair.previous;
    repair.lastFixes = applied.applied;
    repair.fixes += applied.applied;
    setText(i, std::move(applied.text));
    return true;
  }

  /// True when a file got its text from before the last round back.
  bool takeBackWorse(const std::vector<CheckedFile> &files) {
    bool tookBack = false;
    for (std::size_t i = 0; i < repairs_.size(); ++i) {
      Repair &repair = repairs_[i];
      const std::size_t errors = errorCount(files[i]);
      if (repair.lastFixes == 0 || errors <= repair.errors) {
        repair.errors = errors;
        continue;
      }
      repair.isFrozen = true;
      repair.fixes -= std::exchange(repair.lastFixes, 0);
      setText(i, std::move(repair.previous));
      tookBack = true;
    }
    return tookBack;
  }

  void setText(std::size_t i, std::string text) {
    workload_.items[i].source = SourceFile::fromText(workload_.items[i].shown, std::move(text));
  }

  FixResult result(std::vector<CheckedFile> files) {
    FixResult fixed;
    for (std::size_t i = 0; i < repairs_.size(); ++i) {
      const std::string_view after = files[i].source.text();
      if (repairs_[i].fixes == 0 || after == repairs_[i].original)
        continue;
      fixed.files.push_back({files[i].path, workload_.items[i].path, std::move(repairs_[i].original),
                             std::string(after), repairs_[i].fixes});
    }
    fixed.remaining = {std::move(files), std::move(workload_.skipped), std::move(workload_.errors)};
    return fixed;
  }

  const CheckOptions &options_;
  FixKind kind_;
  const KnownNames &known_;
  Workload workload_;
  std::vector<Repair> repairs_;
};

} // namespace

FixResult fix(const CheckOptions &options, FixKind kind, const KnownNames &known) {
  return Repairer(options, kind, known).run();
}

std::vector<PathProblem> writeFixes(const std::vector<FixedFile> &files) {
  std::vector<PathProblem> problems;
  for (const FixedFile &file : files)
    if (const std::optional<Error> error = replaceFile(file.place, file.after))
      problems.push_back({file.path, error->message});
  return problems;
}

} // namespace feedhold
