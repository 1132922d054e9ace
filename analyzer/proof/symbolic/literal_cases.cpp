#include "proof/symbolic/literal_cases.h"

namespace feedhold::prove {

using smt::TermId;
using smt::TermKind;
using smt::TermStore;

namespace {

constexpr int kMostConditions = 3; // in a row: beyond, the cases would be many

bool isChoice(const TermStore &store, TermId id) { return store[id].kind == TermKind::Ite; }

bool isAmongLiterals(const TermStore &store, TermId id, int conditions = kMostConditions) {
  if (store.isNumber(id) || !isChoice(store, id))
    return store.isNumber(id);
  const auto &arguments = store[id].arguments;
  return conditions > 0 && isAmongLiterals(store, arguments[1], conditions - 1) &&
         isAmongLiterals(store, arguments[2], conditions - 1);
}

/// What is left of the number where the condition is decided.
TermId where(TermStore &store, TermId condition, bool holds, TermId id) {
  if (!isChoice(store, id))
    return id;
  const std::array arguments{store[id].arguments[0], store[id].arguments[1], store[id].arguments[2]};
  if (arguments[0] == condition)
    return where(store, condition, holds, arguments[holds ? 1 : 2]);
  const TermId ifSo = where(store, condition, holds, arguments[1]);
  return store.ite(arguments[0], ifSo, where(store, condition, holds, arguments[2]));
}

} // namespace

std::optional<LiteralCases> literalCases(TermStore &store, TermId first, TermId second) {
  if ((store.isNumber(first) && store.isNumber(second)) || !isAmongLiterals(store, first) ||
      !isAmongLiterals(store, second))
    return std::nullopt;
  const TermId condition = store[isChoice(store, first) ? first : second].arguments[0];
  const auto in = [&](bool holds) {
    const TermId left = where(store, condition, holds, first);
    return std::array{left, where(store, condition, holds, second)};
  };
  const auto ifSo = in(true);
  return LiteralCases{condition, ifSo, in(false)};
}

} // namespace feedhold::prove
