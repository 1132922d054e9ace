// StepContext: what every part of the semantics needs: the interpretation, the state that it changes, and where it
// stands.
#pragma once

#include "language/dialect/switch_names.h"
#include "meaning/cfg/program_set.h"
#include "meaning/semantics/algebra.h"
#include "meaning/semantics/modal_table.h"
#include "meaning/semantics/state.h"

#include <span>

namespace feedhold {

template <ValueAlgebra R> struct StepContext {
  R &interpretation;
  MachineState<R> &state;
  const ProgramSet &programs;
  const ProgramFile &file;
  const ModalTable &modes;
  BlockId block;
  bool passesDefinition = false; // names that are unset do not stop the control here, and give any number

  using Value = typename R::Value;
  using Truth = typename R::Truth;

  const SyntaxTree &tree() const { return *file.tree; }
  const Dialect &dialect() const { return *file.dialect; }
  const Behaviour &behaviour() const { return file.dialect->behaviour; }
  Span place() const { return tree().blocks[block].span(); }

  Truth either(Truth a, Truth b) const {
    return interpretation.negation(interpretation.both(interpretation.negation(a), interpretation.negation(b)));
  }
  /// Whether it is so of any of many, by halves: what is added one by one costs the square of their number.
  template <typename Each, typename TruthOf> Truth anyOf(std::span<const Each> all, const TruthOf &truthOf) const {
    if (all.size() < 2)
      return all.empty() ? interpretation.truth(false) : truthOf(all.front());
    const std::size_t half = all.size() / 2;
    return either(anyOf(all.first(half), truthOf), anyOf(all.subspan(half), truthOf));
  }
  bool certain(Truth truth) const { return !interpretation.mayBe(interpretation.negation(truth)); }
  /// By whatever the interpretation can prove: for what is asked seldom.
  bool proved(Truth truth) const {
    if constexpr (requires { interpretation.proves(truth); })
      return certain(truth) || interpretation.proves(truth);
    else
      return certain(truth);
  }
  Value zero() const { return interpretation.number(0); }
  /// A setting of the machine.
  Truth isOn(Switch Switches::*setting) const {
    const Switch said = dialect().switches.*setting;
    return said == Switch::Unknown ? interpretation.setting(idOf(setting)) : interpretation.truth(said == Switch::On);
  }
  /// What no setting decides: so in a run if it is usual, and unknown where all runs are looked at.
  Truth maybe(bool usual) const {
    return interpretation.negation(interpretation.compare(
        Relation::Equal,
        interpretation.either(interpretation.number(usual ? 1 : 0), interpretation.number(usual ? 0 : 1)), zero()));
  }
  Truth maybeNot() const { return maybe(false); }
  /// The modal state of a kind is one of these codes.  Without such a group: `without`.
  Truth inForce(ModalKind kind, std::initializer_list<CodeAction> actions, Truth without) const {
    const auto group = modes.groupOf(kind);
    return group ? interpretation.isOneOf(state.codes[*group], modes.maskOf(kind, actions)) : without;
  }
};

} // namespace feedhold
