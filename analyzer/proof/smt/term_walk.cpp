// Walks over terms.  All go by ascending id, which is arguments first, so that deep terms need no deep stack.
#include "proof/smt/term.h"

#include "base/support/check.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <utility>

namespace feedhold::smt {

namespace {

/// The terms that one walk has seen.  Kept from walk to walk: a store is much larger than what most walks see of it.
class Seen {
public:
  explicit Seen(std::size_t size) {
    if (marks.size() < size)
      marks.resize(size, 0);
    if (++walk == 0) { // all numbers have been used
      std::ranges::fill(marks, 0);
      walk = 1;
    }
  }
  /// False: it was there.
  bool add(TermId term) { return std::exchange(marks[term.index()], walk) != walk; }

private:
  static thread_local std::vector<std::uint32_t> marks; // by term: the last walk that saw it
  static thread_local std::uint32_t walk;
};

thread_local std::vector<std::uint32_t> Seen::marks;
thread_local std::uint32_t Seen::walk = 0;

} // namespace

std::vector<TermId> reachable(const TermStore &store, std::span<const TermId> terms) {
  Seen seen(store.size());
  std::vector<TermId> found;
  const auto visit = [&](TermId term) {
    if (seen.add(term))
      found.push_back(term);
  };
  std::ranges::for_each(terms, visit);
  for (std::size_t next = 0; next < found.size(); ++next)
    std::ranges::for_each(store[found[next]].arguments, visit);
  spend(8 * found.size());
  std::ranges::sort(found);
  return found;
}

std::vector<TermId> variablesOf(const TermStore &store, std::span<const TermId> terms) {
  std::vector<TermId> found = reachable(store, terms);
  std::erase_if(found, [&](TermId term) { return store[term].kind != TermKind::Variable; });
  return found;
}

const std::vector<TermId> &variablesOf(const TermStore &store, TermId term) { return store.variablesOf(term); }

const std::vector<TermId> &TermStore::variablesOf(TermId term) const {
  if (variablesOf_.size() < size())
    variablesOf_.resize(size());
  const std::vector<TermId> *&known = variablesOf_[term.index()];
  if (!known)
    known = &variableLists_.emplace_back(smt::variablesOf(*this, std::span(&term, 1)));
  return *known;
}

TermId withArguments(TermStore &store, TermId id, const std::vector<TermId> &arguments) {
  const TermKind kind = store[id].kind;
  switch (kind) {
  case TermKind::True:
  case TermKind::False:
  case TermKind::Number:
  case TermKind::Variable: return id;
  case TermKind::Add: return store.add(arguments);
  case TermKind::Multiply: return store.multiply(arguments);
  case TermKind::Divide: return store.divide(arguments[0], arguments[1]);
  case TermKind::Less: return store.less(arguments[0], arguments[1]);
  case TermKind::LessOrEqual: return store.lessOrEqual(arguments[0], arguments[1]);
  case TermKind::Equal: return store.equal(arguments[0], arguments[1]);
  case TermKind::And: return store.logicalAnd(arguments);
  case TermKind::Or: return store.logicalOr(arguments);
  case TermKind::Not: return store.logicalNot(arguments[0]);
  case TermKind::Ite: return store.ite(arguments[0], arguments[1], arguments[2]);
  case TermKind::Apply: return store.apply(store[id].function, arguments);
  }
  FEEDHOLD_UNREACHABLE("a new kind of term needs its factory");
}

TermId substitute(TermStore &store, TermId term, const Substitution &substitution) {
  const std::vector<TermId> parts = reachable(store, std::span(&term, 1)); // the last is the whole
  std::vector<TermId> results = parts;
  const auto resultOf = [&](TermId part) {
    return results[static_cast<std::size_t>(std::ranges::lower_bound(parts, part) - parts.begin())];
  };
  bool isChanged = false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (const auto given = substitution.find(parts[i]); given != substitution.end()) {
      results[i] = given->second;
      isChanged = true;
    } else if (isChanged) {
      std::vector<TermId> arguments = store[parts[i]].arguments;
      std::ranges::transform(arguments, arguments.begin(), resultOf);
      if (arguments != store[parts[i]].arguments)
        results[i] = withArguments(store, parts[i], arguments);
    }
  }
  return results.back();
}

bool isSquareOfSum(const TermStore &store, const Term &term) {
  return term.kind == TermKind::Multiply && term.arguments.size() == 2 && term.arguments[0] == term.arguments[1] &&
         store[term.arguments[0]].kind == TermKind::Add;
}

bool isRounding(const Term &term) {
  return term.kind == TermKind::Apply && (term.function == Function::Nearest || term.function == Function::Near);
}

TermId withoutRounding(TermStore &store, TermId term) {
  if (!store.shape(term).hasRounding)
    return term;
  Substitution exact;
  for (const TermId part : reachable(store, std::span(&term, 1))) {
    const Term &each = store[part];
    if (isRounding(each))
      exact.emplace(part, substitute(store, each.arguments[0], exact));
  }
  return exact.empty() ? term : substitute(store, term, exact);
}

} // namespace feedhold::smt
