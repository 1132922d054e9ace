// Model: values of variables by name; and what a term is under it.
#pragma once

#include "proof/smt/term.h"

#include <map>
#include <string>
#include <unordered_map>
#include <variant>

namespace feedhold::smt {

using Value = std::variant<bool, Number>;
using Model = std::map<std::string, Value, std::less<>>;

/// What a variable is that the model does not name.
enum class OtherVariables : std::uint8_t { Unknown, Zero };

/// The values of terms under one model; each is found once.
class Evaluation {
public:
  /// The model lives longer.
  Evaluation(const TermStore &store, const Model &model, OtherVariables others)
      : store_(store), model_(model), others_(others) {}

  /// The exact value; absent when a variable is unknown, a divisor is 0, or a function has no rational value that is
  /// known.  Connectives and conditions need only what decides them.
  const std::optional<Value> &of(TermId term);
  /// Of a condition: its value is known, and it is this one.
  bool is(TermId condition, bool truth);

private:
  std::optional<Value> found(const Term &term) const;
  std::optional<Value> ofVariable(const Term &term) const;
  std::optional<Value> junction(const Term &term) const;
  std::optional<std::vector<Number>> numbers(const Term &term) const;
  const std::optional<Value> &known(TermId term) const { return known_.at(term.index()); }

  const TermStore &store_;
  const Model &model_;
  OtherVariables others_;
  std::unordered_map<std::uint32_t, std::optional<Value>> known_; // by term
};

/// Evaluation::of, of one term.
std::optional<Value> evaluate(const TermStore &store, TermId term, const Model &model);
/// Of a condition: its value is known, and it holds.
bool isTrue(const TermStore &store, TermId condition, const Model &model);

} // namespace feedhold::smt
