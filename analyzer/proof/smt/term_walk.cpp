// Walks over terms.  All go by ascending id, which is arguments first, so that deep terms need no deep stack.
#include "proof/smt/term.h"

#include "base/support/check.h"
#include "proof/smt/steps.h"

#include <algorithm>

namespace feedhold::smt {

std::vector<TermId> reachable(const TermStore &store, std::span<const TermId> terms) {
  std::vector<bool> seen(store.size(), false);
  std::vector<TermId> open, found;
  auto visit = [&](TermId term) {
    if (seen[term.index()])
      return;
    seen[term.index()] = true;
    open.push_back(term);
    found.push_back(term);
  };
  for (TermId term : terms)
    visit(term);
  while (!open.empty()) {
    TermId term = open.back();
    open.pop_back();
    for (TermId argument : store[term].arguments)
      visit(argument);
  }
  spend(store.size() / 128 + 8 * found.size());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<TermId> variablesOf(const TermStore &store, std::span<const TermId> terms) {
  std::vector<TermId> found = reachable(store, terms);
  std::erase_if(found, [&](TermId term) { return store[term].kind != TermKind::Variable; });
  return found;
}

const std::vector<TermId> &variablesOf(const TermStore &store, TermId term) { return store.variablesOf(term); }

const std::vector<TermId> &TermStore::variablesOf(TermId term) const {
  const auto known = variablesOf_.find(term.index());
  return known != variablesOf_.end()
             ? known->second
             : variablesOf_.emplace(term.index(), smt::variablesOf(*this, std::span(&term, 1))).first->second;
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
  Substitution done = substitution;
  for (TermId id : reachable(store, std::span(&term, 1))) {
    if (done.contains(id))
      continue;
    std::vector<TermId> arguments = store[id].arguments;
    for (TermId &argument : arguments)
      argument = done.at(argument);
    done.emplace(id, arguments == store[id].arguments ? id : withArguments(store, id, arguments));
  }
  return done.at(term);
}

bool isRounding(const Term &term) {
  return term.kind == TermKind::Apply && (term.function == Function::Nearest || term.function == Function::Near);
}

TermId withoutRounding(TermStore &store, TermId term) {
  Substitution exact;
  for (const TermId part : reachable(store, std::span(&term, 1))) {
    const Term &each = store[part];
    if (isRounding(each))
      exact.emplace(part, substitute(store, each.arguments[0], exact));
  }
  return exact.empty() ? term : substitute(store, term, exact);
}

} // namespace feedhold::smt
