#include "proof/smt/s_expression.h"
#include "proof/smt/smtlib.h"

namespace feedhold::smt {
namespace {

/// Thrown and caught within this file.
struct Unreadable {
  std::string reason;
};

using Scope = std::map<std::string, TermId, std::less<>>;

class Reader {
public:
  explicit Reader(TermStore &store) : store_(store) {}

  void command(const SExpression &item) {
    if (item.isCall("assert"))
      formulas.push_back(boolean(part(item, 1), {}));
    else if (item.isCall("declare-const"))
      globals_.insert_or_assign(symbol(item), store_.variable(symbol(item), sort(part(item, 2))));
    else if (item.isCall("declare-fun"))
      declareFunction(item);
    else if (item.isCall("define-fun"))
      macros_.insert_or_assign(symbol(item), Macro{part(item, 2).items, part(item, 4)});
    else if (!item.isCall("set-logic") && !item.isCall("check-sat") && !item.isCall("set-info") &&
             !item.isCall("set-option") && !item.isCall("exit") && !item.isCall("get-model"))
      throw Unreadable{"an unknown command"};
  }

  std::vector<TermId> formulas;

private:
  struct Macro {
    std::vector<SExpression> parameters;
    SExpression body;
  };

  static const SExpression &part(const SExpression &item, std::size_t index) {
    if (item.items.size() <= index)
      throw Unreadable{"a list is too short"};
    return item.items[index];
  }

  static std::string symbol(const SExpression &item) {
    if (!part(item, 1).isAtom())
      throw Unreadable{"a name is missing"};
    return part(item, 1).atom;
  }

  static Sort sort(const SExpression &item) {
    if (item.isAtom("Bool"))
      return Sort::Bool;
    if (item.isAtom("Int"))
      return Sort::Int;
    if (item.isAtom("Real"))
      return Sort::Real;
    throw Unreadable{"an unknown sort"};
  }

  void declareFunction(const SExpression &item) {
    if (symbol(item).starts_with("feedhold."))
      return;
    if (!part(item, 2).items.empty())
      throw Unreadable{"a function of its own"};
    globals_.insert_or_assign(symbol(item), store_.variable(symbol(item), sort(part(item, 3))));
  }

  TermId boolean(const SExpression &item, const Scope &scope) {
    const TermId id = term(item, scope);
    if (store_.sort(id) != Sort::Bool)
      throw Unreadable{"a number stands where a Bool should"};
    return id;
  }

  TermId numeric(const SExpression &item, const Scope &scope) {
    const TermId id = term(item, scope);
    if (store_.sort(id) == Sort::Bool)
      throw Unreadable{"a Bool stands where a number should"};
    return id;
  }

  TermId term(const SExpression &item, const Scope &scope) {
    if (item.isAtom())
      return atom(item, scope);
    if (item.items.empty() || !item.items[0].isAtom())
      throw Unreadable{"a list without a head"};
    const std::string &head = item.items[0].atom;
    if (head == "let")
      return let(item, scope);
    if (head == "ite") {
      TermId condition = boolean(part(item, 1), scope), whenTrue = term(part(item, 2), scope);
      TermId whenFalse = term(part(item, 3), scope);
      if ((store_.sort(whenTrue) == Sort::Bool) != (store_.sort(whenFalse) == Sort::Bool))
        throw Unreadable{"branches of two sorts"};
      return store_.ite(condition, whenTrue, whenFalse);
    }
    if (auto macro = macros_.find(head); macro != macros_.end())
      return expand(macro->second, item, scope);
    if (head == "and" || head == "or" || head == "not" || head == "=>")
      return connective(item, scope);
    if (head == "=" && store_.sort(term(part(item, 1), scope)) == Sort::Bool)
      return store_.equal(boolean(part(item, 1), scope), boolean(part(item, 2), scope));
    return arithmetic(item, scope);
  }

  TermId atom(const SExpression &item, const Scope &scope) {
    if (auto local = scope.find(item.atom); local != scope.end())
      return local->second;
    if (auto global = globals_.find(item.atom); global != globals_.end())
      return global->second;
    if (auto macro = macros_.find(item.atom); macro != macros_.end())
      return expand(macro->second, item, scope);
    if (item.atom == "true")
      return store_.yes();
    if (item.atom == "false")
      return store_.no();
    if (std::optional<Number> value = Number::parse(item.atom))
      return store_.number(*value);
    throw Unreadable{"an unknown name `" + item.atom + "`"};
  }

  TermId let(const SExpression &item, const Scope &scope) {
    Scope inner = scope;
    for (const SExpression &binding : part(item, 1).items)
      inner.insert_or_assign(part(binding, 0).atom, term(part(binding, 1), scope));
    return term(part(item, 2), inner);
  }

  TermId expand(const Macro &macro, const SExpression &item, const Scope &scope) {
    if (item.items.size() != (macro.parameters.empty() ? 0 : macro.parameters.size() + 1))
      throw Unreadable{"a definition got the wrong number of arguments"};
    if (macro.parameters.empty())
      if (auto known = expanded_.find(item.atom); known != expanded_.end())
        return known->second;
    Scope inner;
    for (std::size_t i = 0; i < macro.parameters.size(); ++i)
      inner.insert_or_assign(part(macro.parameters[i], 0).atom, term(item.items[i + 1], scope));
    TermId result = term(macro.body, inner);
    if (macro.parameters.empty())
      expanded_.emplace(item.atom, result);
    return result;
  }

  TermId connective(const SExpression &item, const Scope &scope) {
    std::vector<TermId> parts;
    for (std::size_t i = 1; i < item.items.size(); ++i)
      parts.push_back(boolean(item.items[i], scope));
    const std::string &head = item.items[0].atom;
    if (head == "and")
      return store_.logicalAnd(parts);
    if (head == "or")
      return store_.logicalOr(parts);
    if (parts.size() != (head == "not" ? 1u : 2u))
      throw Unreadable{"a connective got the wrong number of arguments"};
    return head == "not" ? store_.logicalNot(parts[0]) : store_.implies(parts[0], parts[1]);
  }

  TermId arithmetic(const SExpression &item, const Scope &scope) {
    std::vector<TermId> parts;
    for (std::size_t i = 1; i < item.items.size(); ++i)
      parts.push_back(numeric(item.items[i], scope));
    const std::string &head = item.items[0].atom;
    if (parts.empty())
      throw Unreadable{"`" + head + "` without arguments"};
    if (head == "+")
      return store_.add(parts);
    if (head == "*")
      return store_.multiply(parts);
    if (head == "-" && parts.size() == 1)
      return store_.negate(parts[0]);
    if (head == "-" || head == "/") {
      TermId result = parts[0];
      for (std::size_t i = 1; i < parts.size(); ++i)
        result = head == "-" ? store_.subtract(result, parts[i]) : store_.divide(result, parts[i]);
      return result;
    }
    if (head == "to_real")
      return parts[0];
    if (head == "to_int")
      return store_.floor(parts[0]);
    if (head == "distinct" && parts.size() == 2)
      return store_.notEqual(parts[0], parts[1]);
    return function(head, parts);
  }

  TermId function(const std::string &head, const std::vector<TermId> &parts) {
    for (std::size_t index = 0; index <= static_cast<std::size_t>(kLastFunction); ++index) {
      const Function known = static_cast<Function>(index);
      if (head == "feedhold." + std::string(nameOf(known)) && parts.size() == arity(known))
        return store_.apply(known, parts);
    }
    return chain(head, parts);
  }

  /// `(< a b c)` is a < b and b < c.
  TermId chain(const std::string &head, const std::vector<TermId> &parts) {
    TermId result = store_.yes();
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
      const TermId left = parts[i], right = parts[i + 1];
      if (head == "<")
        result = store_.logicalAnd(result, store_.less(left, right));
      else if (head == "<=")
        result = store_.logicalAnd(result, store_.lessOrEqual(left, right));
      else if (head == ">")
        result = store_.logicalAnd(result, store_.less(right, left));
      else if (head == ">=")
        result = store_.logicalAnd(result, store_.lessOrEqual(right, left));
      else if (head == "=")
        result = store_.logicalAnd(result, store_.equal(left, right));
      else
        throw Unreadable{"an unknown function `" + head + "`"};
    }
    if (parts.size() < 2)
      throw Unreadable{"an unknown function `" + head + "`"};
    return result;
  }

  TermStore &store_;
  std::map<std::string, TermId, std::less<>> globals_;
  std::map<std::string, Macro, std::less<>> macros_;
  std::map<std::string, TermId, std::less<>> expanded_;
};

} // namespace

Result<std::vector<TermId>> readSmtLib(TermStore &store, std::string_view text) {
  Result<std::vector<SExpression>> items = readSExpressions(text);
  if (!items)
    return items.error();
  Reader reader(store);
  try {
    for (const SExpression &item : items.value())
      reader.command(item);
  } catch (const Unreadable &unreadable) {
    return Error{unreadable.reason};
  }
  return std::move(reader.formulas);
}

} // namespace feedhold::smt
