#include "language/dialect/folder_vote.h"

#include <algorithm>

namespace feedhold {
namespace {

constexpr int kMostOfOneFile = 20; // one file does not outvote all others
constexpr int kMostOfFolder = 10;  // as much as two or three marks in the text of the file

constexpr std::size_t kFewestSpeakers = 3;
constexpr std::size_t kFewestOf = 8; // one program of so many, and more than speak for any control that is read

/// What the text says, `#100` or `IF`, is said for the controls of several makers.
bool fitsSeveral(const LanguageGuess &guess) {
  constexpr std::ptrdiff_t kSeveral = 4;
  constexpr int kAlike = 3;
  const int best = *std::max_element(guess.scores.begin(), guess.scores.end());
  return std::count_if(guess.scores.begin(), guess.scores.end(),
                       [best](int score) { return score >= best - kAlike; }) >= kSeveral;
}

std::size_t kindOf(const Dialect &dialect) { return dialect.grammar.oWords ? 1 : 0; }

int voteOf(const LanguageGuess &file, std::size_t dialect) {
  const int best = *std::max_element(file.scores.begin(), file.scores.end());
  return std::max(file.scores[dialect] - best, -kMostOfOneFile);
}

} // namespace

void FolderVote::add(const LanguageGuess &file) {
  if (!file.looksLikeProgram)
    return;
  ++programs_;
  if (file.foreign != nullptr) {
    auto &votes = foreign_[file.foreign->name];
    votes = {file.foreign, votes.second + 1};
    return;
  }
  if (file.gCodeSystem && file.dialect->machine == MachineKind::Turning)
    gCodeSystems_.insert(*file.gCodeSystem);
  hasMarks_[kindOf(*file.dialect)] |= file.hasOwnMarks;
  if (file.basis == GuessBasis::Text)
    ++speakers_[file.dialect];
  distinct_ += file.basis == GuessBasis::Text && file.kin == nullptr && !fitsSeveral(file) ? 1U : 0U;
  sums_.resize(file.scores.size());
  for (std::size_t i = 0; i < sums_.size(); ++i)
    sums_[i] += voteOf(file, i);
}

bool FolderVote::speaksFor(const Dialect *dialect) const {
  std::size_t all = 0;
  for (const auto &[other, files] : speakers_)
    all += files;
  const auto own = speakers_.find(dialect);
  return all >= kFewestSpeakers && own != speakers_.end() && own->second * 3 >= all * 2;
}

bool FolderVote::isClear() const {
  return commonForeign() != nullptr ||
         std::any_of(speakers_.begin(), speakers_.end(), [&](const auto &each) { return speaksFor(each.first); });
}

/// The language of more than half of the programs.  Where it looks like Macro B, programs that fit several controls do
/// not speak against it.
const ForeignLanguage *FolderVote::commonForeign() const {
  for (const auto &[name, votes] : foreign_) {
    const auto &[language, files] = votes;
    const bool isMacroB = language->resemblance == Resemblance::MacroB;
    if (files * 2 > programs_ || (isMacroB && files * kFewestOf >= programs_ && files > distinct_))
      return language;
  }
  return nullptr;
}

LanguageGuess FolderVote::decide(const LanguageGuess &own) const {
  if (!own.looksLikeProgram || own.foreign != nullptr)
    return own;
  LanguageGuess guess = own;
  if (!guess.gCodeSystem && gCodeSystems_.size() == 1)
    guess.gCodeSystem = *gCodeSystems_.begin();
  if (const ForeignLanguage *foreign = commonForeign();
      foreign != nullptr && (own.basis == GuessBasis::Nothing || own.kin == foreign || fitsSeveral(own))) {
    guess.dialect = nullptr;
    guess.foreign = foreign;
    guess.basis = GuessBasis::Neighbours;
    guess.reasons = {"most programs of the folder"};
    return guess;
  }
  guess.hasOwnMarks = own.hasOwnMarks || hasMarks_[kindOf(*own.dialect)];
  if (sums_.empty())
    return guess;
  std::vector<int> others = sums_; // what the program itself says counts once
  for (std::size_t i = 0; i < others.size(); ++i)
    others[i] -= voteOf(own, i);
  const int most = *std::max_element(others.begin(), others.end());
  std::vector<int> scores = own.scores;
  for (std::size_t i = 0; i < scores.size(); ++i)
    scores[i] += std::max(others[i] - most, -kMostOfFolder);
  const Dialect *dialect = likeliestDialect(scores, *registry_);
  // A control with o-words has no `GOTO`, and no lathe stands in a folder `mill`: what the programs beside it say does
  // not hold for this one.
  const bool becomesNgc = dialect->grammar.oWords && !own.dialect->grammar.oWords;
  const bool becomesLathe = dialect->machine == MachineKind::Turning && own.dialect->machine != MachineKind::Turning;
  if (dialect != own.dialect && !(becomesNgc && own.hasJumps) && !(becomesLathe && own.isNamedForMilling)) {
    guess.dialect = dialect;
    guess.basis = GuessBasis::Neighbours;
    guess.reasons = {"the other programs of the folder"};
  }
  return guess;
}

} // namespace feedhold
