// FolderVote: what the files of one folder say together.  A macro of ten lines may fit every control; the programs
// beside it tell for which one it was written.
#pragma once

#include "language/dialect/registry.h"

#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

namespace feedhold {

class FolderVote {
public:
  explicit FolderVote(const DialectRegistry &registry) : registry_(&registry) {}

  void add(const LanguageGuess &file);
  /// Enough of the programs speak for one dialect; else a larger folder is to be asked.
  bool isClear() const;
  /// Most of those that speak for any do so for this one.
  bool speaksFor(const Dialect *dialect) const;
  /// The guess for a file of the folder, which may have voted itself.  What its own text says clearly counts more than
  /// what the others say.
  LanguageGuess decide(const LanguageGuess &own) const;

private:
  const ForeignLanguage *commonForeign() const;

  const DialectRegistry *registry_;
  std::vector<int> sums_; // by dialect, of what each file scores below its best
  std::size_t programs_ = 0;
  std::size_t distinct_ = 0;                        // programs that fit a few dialects only, and no foreign language
  std::map<const Dialect *, std::size_t> speakers_; // programs whose text speaks for a dialect
  std::map<std::string_view, std::pair<const ForeignLanguage *, std::size_t>> foreign_; // by name
  std::set<GCodeSystem> gCodeSystems_;
  std::array<bool, 2> hasMarks_{}; // some program that is read as Macro B, or with o-words, has marks of its own
};

} // namespace feedhold
