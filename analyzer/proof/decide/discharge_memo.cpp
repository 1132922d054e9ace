#include "proof/decide/discharge_memo.h"

#include "base/support/memo.h"
#include "base/support/process.h"
#include "proof/smt/steps.h"

namespace feedhold::prove {
namespace {

/// Shorter searches are as fast as a look into the memo.
constexpr std::uint64_t kWorthKeeping = 1'000;
constexpr std::size_t kMostBytes = 48 << 20;

/// The claim, with its variables by number.
class Key {
public:
  Key(const check::UnsatProblem &claim, std::uint64_t workLimit) {
    add(std::to_string(workLimit));
    for (const check::ClaimVariable &variable : claim.variables)
      text_ += variable.range == check::Range::Integer ? 'i' : 'r';
    write(claim.conjunction);
  }
  std::string take() { return std::move(text_); }

private:
  void add(std::string_view part) {
    text_ += part;
    text_ += ' ';
  }
  void write(const check::Conjunction &conjunction) {
    for (const check::Constraint &constraint : conjunction.constraints) {
      text_ += static_cast<char>('A' + static_cast<int>(constraint.relation));
      for (const auto &[monomial, coefficient] : constraint.polynomial) {
        add(coefficient.toString());
        for (const std::uint32_t index : monomial)
          add(std::to_string(index));
        text_ += ';';
      }
    }
    for (const check::Clause &clause : conjunction.clauses) {
      text_ += '[';
      for (const check::Conjunction &alternative : clause.alternatives) {
        text_ += '|';
        write(alternative);
      }
      text_ += ']';
    }
  }
  std::string text_;
};

/// A solver that had to be stopped, or is missing, may answer the next time; and what rests on such a failure has to be
/// seen as doing so (failedChildren), since it must not be kept for other runs.
template <typename Ask> smt::Answer askOnce(Memo<smt::Answer> &memo, std::string key, const Ask &ask) {
  if (auto known = memo.find(key))
    return *known;
  const std::uint64_t failures = failedChildren();
  smt::Answer answer = ask();
  if (failedChildren() == failures)
    memo.keep(std::move(key), answer);
  return answer;
}

} // namespace

SearchResult searchOnce(const check::UnsatProblem &claim, std::uint64_t workLimit) {
  static Memo<SearchResult> memo(kMostBytes);
  std::string key = Key(claim, workLimit).take();
  smt::spend(key.size());
  // A search that is taken from the memo costs what it cost: what is given up must not hang on who searched first.
  if (auto known = memo.find(key)) {
    smt::spend(known->steps);
    return *known;
  }
  const smt::Steps steps(~std::uint64_t{0}, smt::Steps::AtEnd::Throw);
  SearchResult result = searchCertificate(claim, workLimit);
  result.steps = steps.spent();
  if (result.work >= kWorthKeeping)
    memo.keep(std::move(key), result);
  return result;
}

smt::Answer askZ3Once(const std::string &smtlib, smt::Arithmetic arithmetic, std::uint64_t resources) {
  static Memo<smt::Answer> memo(kMostBytes);
  return askOnce(memo, std::to_string(resources) + " " + smtlib,
                 [&] { return smt::askZ3(smtlib, arithmetic, resources); });
}

smt::Answer askCvc5Once(const std::string &smtlib, std::uint64_t resources) {
  static Memo<smt::Answer> memo(kMostBytes);
  return askOnce(memo, std::to_string(resources) + " " + smtlib, [&] { return smt::askCvc5(smtlib, resources); });
}

} // namespace feedhold::prove
