#include "soundness/containment.h"

#include "inference/absint/describe.h"

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace feedhold::soundness {

namespace {

using ConcreteState = MachineState<ConcreteInterpretation>;

std::string text(const ConcreteValue &value) { return value.vacant ? "vacant" : fmt::format("{:.17g}", value.number); }

class Containment {
public:
  Containment(const ConcreteState &state, const AbstractState &abstract, const EntryValues &entry,
              const ModalTable &modes, const Dialect &dialect)
      : state_(state), abstract_(abstract), entry_(entry), modes_(modes), dialect_(dialect),
        interpretation_(dialect, entry.given) {}

  std::optional<std::string> run() {
    for (std::uint32_t local = 1; local <= kLocalVariables && interpretation_.isLocal(local); ++local)
      value(fmt::format("#{}", local), state_.locals[local], abstract_.locals[local]);
    variables();
    axes("position", state_.position, abstract_.position);
    axes("shift", state_.shift, abstract_.shift);
    axes("local shift", state_.local, abstract_.local);
    axes("scale", state_.transform.scale, abstract_.transform.scale);
    axes("scale centre", state_.transform.scaleCentre, abstract_.transform.scaleCentre);
    axes("pending", state_.transform.pending, abstract_.transform.pending);
    axes("mirror", state_.transform.mirrorAt, abstract_.transform.mirrorAt);
    value("angle", state_.transform.angle, abstract_.transform.angle);
    value("length offset", state_.lengthOffset, abstract_.lengthOffset);
    for (std::size_t i = 0; i < state_.words.size(); ++i)
      value(fmt::format("word {}", kModalWords[i]), state_.words[i], abstract_.words[i]);
    cycle();
    for (std::size_t i = 0; i < state_.transform.centre.size(); ++i)
      value("centre of rotation", state_.transform.centre[i], abstract_.transform.centre[i]);
    codes();
    flags();
    return std::move(why_);
  }

private:
  void fail(std::string why) {
    if (!why_)
      why_ = std::move(why);
  }
  void axes(std::string_view what, const std::array<ConcreteValue, kAxisCount> &concrete,
            const std::array<AbstractValue, kAxisCount> &abstract) {
    for (std::size_t axis = 0; axis < kAxisCount; ++axis)
      value(fmt::format("{} {}", what, kAxisLetters[axis]), concrete[axis], abstract[axis]);
  }
  /// The set of a rounded number is that of doubles.
  bool contains(const AbstractNumber &number, double value) const {
    return number.contains(value) ||
           (entry_.numbers == NumberModel::Mantissa32 && !number.isExact() && number.interval().contains(value));
  }
  void value(const std::string &name, const ConcreteValue &concrete, const AbstractValue &abstract) {
    const bool fits = concrete.vacant ? abstract.mayBeVacant()
                                      : abstract.mayBeNumber() && contains(abstract.number(), concrete.number);
    if (!fits)
      fail(fmt::format("{} is {}, not {}", name, text(concrete), describe(abstract)));
    if (abstract.origin())
      origin(name, concrete, *abstract.origin());
  }

  // ---- relations ----

  void origin(const std::string &name, const ConcreteValue &concrete, const Origin &origin) {
    if (origin.symbol == kZeroSymbol) {
      if (!concrete.vacant)
        requireNear(name, concrete.number, 0, origin.offset);
      return;
    }
    if (isEntrySymbol(origin.symbol)) {
      const ConcreteValue start = atEntry(origin.symbol);
      if (origin.offset.isZero() && start.vacant != concrete.vacant)
        fail(fmt::format("{} is {}, not as at entry: {}", name, text(concrete), text(start)));
      else if (!concrete.vacant)
        requireNear(name, concrete.number, start.vacant ? 0 : start.number, origin.offset);
      return;
    }
    const auto [known, isNew] = fresh_.try_emplace(origin.symbol, Known{name, concrete, origin.offset});
    if (isNew || (concrete.vacant && known->second.value.vacant))
      return;
    const Known &other = known->second;
    const auto apart = subtract(origin.offset, other.offset);
    if (concrete.vacant != other.value.vacant) {
      if (apart && apart->isZero())
        fail(fmt::format("{} is {}, no copy of {}, {}", name, text(concrete), other.name, text(other.value)));
    } else if (apart) {
      requireNear(name + " by " + other.name, concrete.number, other.value.number, *apart);
    }
  }
  void requireNear(const std::string &name, double value, double base, const Rational &offset) {
    const double wanted = base + offset.toDouble();
    const double size = std::max({1.0, std::fabs(value), std::fabs(base), std::fabs(offset.toDouble())});
    if (!(std::fabs(value - wanted) <= 1e-6 * size))
      fail(fmt::format("{} is {:.17g}, not {:.17g} + {}", name, value, base, offset.toString()));
  }
  ConcreteValue atEntry(std::uint32_t symbol) const {
    if (symbol >= kWordSymbols)
      return entry_.state.words[symbol - kWordSymbols];
    if (symbol >= kModalSymbols)
      return interpretation_.numberOfCode(entry_.state.codes[symbol - kModalSymbols], modes_,
                                          static_cast<std::uint8_t>(symbol - kModalSymbols));
    if (symbol >= kPositionSymbols)
      return entry_.state.position[symbol - kPositionSymbols];
    return interpretation_.isLocal(symbol) ? entry_.state.locals[symbol] : interpretation_.given(symbol);
  }

  // ---- the parts ----

  void variables() {
    const AbstractInterpretation interpretation(dialect_);
    for (const auto &[number, abstract] : abstract_.variables.entries()) {
      const auto *known = state_.variables.find(number);
      value(fmt::format("#{}", number), known ? *known : atEntry(number), abstract);
    }
    for (const auto &[number, concrete] : state_.variables.entries())
      if (!abstract_.variables.find(number))
        value(fmt::format("#{}", number), concrete, interpretation.unwritten(abstract_, number));
  }
  void cycle() {
    value("bottom of cycle", state_.cycle.bottom, abstract_.cycle.bottom);
    value("R of cycle", state_.cycle.retract, abstract_.cycle.retract);
    value("initial level", state_.cycle.initial, abstract_.cycle.initial);
    value("Q of cycle", state_.cycle.peck, abstract_.cycle.peck);
    value("P of cycle", state_.cycle.dwell, abstract_.cycle.dwell);
  }
  void codes() {
    for (std::size_t group = 1; group < kModalGroups; ++group)
      code(fmt::format("group {}", group), state_.codes[group], abstract_.codes[group], entry_.state.codes[group]);
    code("spindle", state_.spindle, abstract_.spindle, entry_.state.spindle);
  }
  void code(const std::string &name, std::uint8_t concrete, CodeSet abstract, std::uint8_t start) {
    if (concrete < CodeSet::kMostCodes && abstract.contains(concrete))
      return;
    if (!abstract.mayBeAtEntry() || concrete != start)
      fail(fmt::format("{}: code {} is not in the set {:#x}", name, concrete, abstract.codes()));
  }
  void flags() {
    truth("length changed", state_.lengthChanged, abstract_.lengthChanged);
    for (const Axis axis : kAllAxes)
      truth(fmt::format("{} moved", letterOf(axis)), state_.axisMoved[indexOf(axis)],
            abstract_.axisMoved[indexOf(axis)]);
    truth("transformed", state_.transformed, abstract_.transformed);
    for (const auto &[number, entered] : state_.enteredLoops) {
      Truth known = Truth::True;
      for (const auto &[loop, is] : abstract_.enteredLoops)
        known = loop == number ? is : known;
      truth(fmt::format("DO{} entered", number), entered, known);
    }
    modalCalls();
  }
  void truth(const std::string &name, bool concrete, Truth abstract) {
    if (!(concrete ? mayBeTrue(abstract) : mayBeFalse(abstract)))
      fail(name + " is otherwise");
  }
  void modalCalls() {
    if (mayBeTrue(abstract_.modalCallsUnknown))
      return;
    if (state_.modalCalls.size() != abstract_.modalCalls.size())
      return fail(fmt::format("{} modal calls, not {}", state_.modalCalls.size(), abstract_.modalCalls.size()));
    for (std::size_t i = 0; i < state_.modalCalls.size(); ++i) {
      const auto &concrete = state_.modalCalls[i];
      const auto &abstract = abstract_.modalCalls[i];
      if (concrete.call != abstract.call || concrete.file != abstract.file)
        fail("another modal call");
      value(fmt::format("L of modal call {}", i), concrete.repeats, abstract.repeats);
      for (std::uint32_t local = 1; local <= kLocalVariables && interpretation_.isLocal(local); ++local)
        value(fmt::format("#{} of modal call {}", local, i), concrete.locals[local], abstract.locals[local]);
    }
  }

  struct Known {
    std::string name;
    ConcreteValue value;
    Rational offset;
  };
  const ConcreteState &state_;
  const AbstractState &abstract_;
  const EntryValues &entry_;
  const ModalTable &modes_;
  const Dialect &dialect_;
  mutable ConcreteInterpretation interpretation_; // notes what it cannot know
  std::map<std::uint32_t, Known> fresh_;
  std::optional<std::string> why_;
};

} // namespace

std::optional<std::string> whyOutside(const ConcreteState &state, const AbstractState &abstract,
                                      const EntryValues &entry, const ModalTable &modes, const Dialect &dialect) {
  return Containment(state, abstract, entry, modes, dialect).run();
}

bool overflows(const ConcreteState &state) {
  bool found = false;
  forEachValue(state, [&found](const ConcreteValue &value) {
    found = found || std::fabs(value.number) > 1e200 || std::isnan(value.number);
  });
  return found;
}

} // namespace feedhold::soundness
