#include "base/support/check.h"
#include "proof/smt/s_expression.h"
#include "proof/smt/smtlib.h"

#include <algorithm>

namespace feedhold::smt {
namespace {

/// Longer texts get a name, so that nothing is copied over and over.
constexpr std::size_t kLongest = 400;

class Writer {
public:
  Writer(const TermStore &store, std::span<const TermId> formulas)
      : store_(store), formulas_(formulas), all_(reachable(store, formulas)) {
    for (TermId id : all_)
      for (TermId argument : store_[id].arguments)
        ++users_[argument];
  }

  std::string write() {
    text_ = "(set-logic " + logic() + ")\n";
    declare();
    for (TermId id : all_) {
      std::string expression = write(store_[id]);
      const bool isLeaf = store_[id].arguments.empty();
      if (!isLeaf && (users_[id] > 1 || expression.size() > kLongest)) {
        const std::string name = "|!t" + std::to_string(id.index()) + "|";
        text_ += "(define-fun " + name + " () " + sortName(store_.sort(id)) + " " + expression + ")\n";
        expression = name;
      }
      written_.emplace(id, std::move(expression));
    }
    for (TermId formula : formulas_)
      text_ += "(assert " + written_.at(formula) + ")\n";
    return text_ + "(check-sat)\n";
  }

private:
  static std::string sortName(Sort sort) {
    switch (sort) {
    case Sort::Bool: return "Bool";
    case Sort::Int: return "Int";
    case Sort::Real: return "Real";
    }
    return "";
  }

  std::string logic() const {
    bool hasInt = false, hasReal = false, hasFunction = false;
    for (TermId id : all_) {
      const Term &term = store_[id];
      const bool isUnknown = term.kind == TermKind::Variable || term.kind == TermKind::Apply;
      hasInt = hasInt || (isUnknown && term.sort == Sort::Int);
      hasReal = hasReal || (isUnknown && term.sort == Sort::Real) || term.kind == TermKind::Divide ||
                (term.kind == TermKind::Number && term.sort == Sort::Real) ||
                (term.kind == TermKind::Apply && term.function == Function::Floor);
      hasFunction = hasFunction || (term.kind == TermKind::Apply && term.function != Function::Floor);
    }
    std::string name = hasFunction ? "QF_UF" : "QF_";
    name += arithmeticOf(store_, formulas_) == Arithmetic::Nonlinear ? "N" : "L";
    return name + (hasInt ? "I" : "") + (hasReal || !hasInt ? "R" : "") + "A";
  }

  void declare() {
    std::vector<bool> declared(32, false);
    for (TermId id : all_) {
      const Term &term = store_[id];
      if (term.kind == TermKind::Variable)
        text_ += "(declare-const " + quotedSymbol(term.name) + " " + sortName(term.sort) + ")\n";
      const std::size_t function = static_cast<std::size_t>(term.function);
      if (term.kind != TermKind::Apply || term.function == Function::Floor || declared[function])
        continue;
      declared[function] = true;
      text_ += "(declare-fun feedhold." + std::string(nameOf(term.function)) +
               (arity(term.function) == 1 ? " (Real) Real)\n" : " (Real Real) Real)\n");
    }
  }

  static std::string number(const Number &value, Sort sort) {
    const std::string suffix = sort == Sort::Real ? ".0" : "";
    const Number magnitude = abs(value);
    std::string text = magnitude.numerator().toString() + suffix;
    if (!value.isInteger())
      text = "(/ " + text + " " + magnitude.denominator().toString() + suffix + ")";
    return value.sign() < 0 ? "(- " + text + ")" : text;
  }

  /// An argument where that sort is wanted.
  std::string argument(TermId id, Sort wanted) const {
    const Term &term = store_[id];
    if (term.kind == TermKind::Number)
      return number(term.number, wanted);
    if (term.sort == Sort::Int && wanted == Sort::Real)
      return "(to_real " + written_.at(id) + ")";
    return written_.at(id);
  }

  std::string call(std::string_view head, const Term &term, Sort wanted) const {
    std::string text = "(" + std::string(head);
    for (TermId id : term.arguments)
      text += " " + argument(id, wanted);
    return text + ")";
  }

  Sort sortOfAll(const Term &term) const {
    const bool whole = std::all_of(term.arguments.begin(), term.arguments.end(),
                                   [this](TermId id) { return store_.sort(id) == Sort::Int; });
    return whole ? Sort::Int : Sort::Real;
  }

  std::string write(const Term &term) const {
    switch (term.kind) {
    case TermKind::True: return "true";
    case TermKind::False: return "false";
    case TermKind::Number: return number(term.number, term.sort);
    case TermKind::Variable: return quotedSymbol(term.name);
    case TermKind::Add: return call("+", term, term.sort);
    case TermKind::Multiply: return call("*", term, term.sort);
    case TermKind::Divide: return call("/", term, Sort::Real);
    case TermKind::Less: return call("<", term, sortOfAll(term));
    case TermKind::LessOrEqual: return call("<=", term, sortOfAll(term));
    case TermKind::Equal: return call("=", term, sortOfAll(term));
    case TermKind::And: return call("and", term, Sort::Bool);
    case TermKind::Or: return call("or", term, Sort::Bool);
    case TermKind::Not: return call("not", term, Sort::Bool);
    case TermKind::Ite:
      return "(ite " + argument(term.arguments[0], Sort::Bool) + " " + argument(term.arguments[1], term.sort) + " " +
             argument(term.arguments[2], term.sort) + ")";
    case TermKind::Apply:
      return call(term.function == Function::Floor ? "to_int" : "feedhold." + std::string(nameOf(term.function)), term,
                  Sort::Real);
    }
    FEEDHOLD_UNREACHABLE("a new kind of term needs its text");
  }

  const TermStore &store_;
  std::span<const TermId> formulas_;
  std::vector<TermId> all_;
  std::map<TermId, std::size_t> users_;
  std::map<TermId, std::string> written_;
  std::string text_;
};

} // namespace

Arithmetic arithmeticOf(const TermStore &store, std::span<const TermId> formulas) {
  for (TermId id : reachable(store, formulas)) {
    const Term &term = store[id];
    if (term.kind == TermKind::Divide || (term.kind == TermKind::Multiply && !store.isNumber(term.arguments[0])))
      return Arithmetic::Nonlinear;
  }
  return Arithmetic::Linear;
}

std::string writeSmtLib(const TermStore &store, std::span<const TermId> formulas) {
  return Writer(store, formulas).write();
}

} // namespace feedhold::smt
