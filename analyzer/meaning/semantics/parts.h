// Parts: the one traversal of a machine state, and what each part of it is.
//
// Whatever is done to a whole state (a traversal, an order, a join, an entry state, "anything may have happened", a
// copy in little room) goes through forEachPart, for every interpretation.  membersOf names the members of each struct
// by structured bindings: a member that is added to a struct and not to its list does not compile, and neither does a
// part without a row in traitsOf.
#pragma once

#include "base/support/match.h"
#include "meaning/semantics/state.h"

#include <optional>
#include <tuple>
#include <type_traits>

namespace feedhold {

/// The parts of a state, in order.  An array, a list or a map has one part for each of its elements.
enum class Part : std::uint8_t {
  LocalVariable,
  Variable,
  Code,
  Position,
  ModalWord,
  CoordinateShift, // G92
  LocalShift,      // G52
  LengthOffset,
  LengthChanged,
  AxisMoved,
  CycleBottom,
  CycleRetract,
  CycleInitial,
  CyclePeck,
  CycleDwell,
  Scale,
  ScaleCentre,
  MirrorAt,
  RotationAngle,
  RotationCentre,
  PendingCoordinate,
  OtherMapping,
  CornerChamfer,
  CornerRadius,
  CornerStart,
  KeptFirst,
  KeptSecond,
  Transformed,
  Spindle,
  ModalCallRepeats,
  ModalCallLocal,
  OtherModalCalls,
  EnteredLoop,
  Counter,
  SavedCode,
  SavedWord,
  RestoresModes,
};

/// A part, and which of its elements: the index in an array, the number of a variable or of a loop; else 0.
struct PartId {
  Part part;
  std::uint32_t key = 0;
  friend bool operator==(const PartId &, const PartId &) = default;
};

/// What a part can hold, whatever happens.
enum class PartDomain : std::uint8_t {
  Vacancy, // #0: it is never assigned
  Number,  // never vacant
  Value,   // vacant or a number
  Code,    // of a modal group
  Truth,
};
/// What the start of a program finds in a part.
enum class PartEntry : std::uint8_t {
  Given,   // whatever the caller or the operator left: an input of the program
  Unknown, // the same, and the program cannot ask for it
  Neutral, // told relative to what was there: nothing of the program's own yet
};
/// What stands in a part when something that is not modelled may have happened.
enum class PartHavoc : std::uint8_t {
  Anything,
  Mapping, // anything where a mapping is or may be in force; else neutral: one is taken not to be left behind
  Pending, // likewise, and where the part is not neutral already
  Neutral, // nothing of the kind is left behind
};
/// What a part holds when nothing has set it, and what the element stands for that a list does not have.
enum class PartNeutral : std::uint8_t { Vacant, Zero, One, No, Yes, PowerOn };

struct PartTraits {
  PartDomain domain;
  PartEntry entry;
  PartHavoc havoc;
  PartNeutral neutral;
};

constexpr PartTraits traitsOf(Part part) {
  switch (part) {
  case Part::LocalVariable:
  case Part::Variable:
  case Part::ModalWord: return {PartDomain::Value, PartEntry::Given, PartHavoc::Anything, PartNeutral::Vacant};
  case Part::Code:
  case Part::Spindle: return {PartDomain::Code, PartEntry::Given, PartHavoc::Anything, PartNeutral::PowerOn};
  case Part::Position: return {PartDomain::Number, PartEntry::Given, PartHavoc::Anything, PartNeutral::Zero};
  case Part::CoordinateShift:
  case Part::LocalShift:
  case Part::LengthOffset: return {PartDomain::Number, PartEntry::Unknown, PartHavoc::Anything, PartNeutral::Zero};
  case Part::CycleBottom:
  case Part::CycleRetract:
  case Part::CycleInitial:
  case Part::CyclePeck:
  case Part::CycleDwell: return {PartDomain::Value, PartEntry::Unknown, PartHavoc::Anything, PartNeutral::Vacant};
  case Part::Scale: return {PartDomain::Number, PartEntry::Neutral, PartHavoc::Mapping, PartNeutral::One};
  case Part::RotationAngle: return {PartDomain::Number, PartEntry::Neutral, PartHavoc::Mapping, PartNeutral::Zero};
  case Part::ScaleCentre: // a centre outlasts its mapping
  case Part::RotationCentre: return {PartDomain::Number, PartEntry::Neutral, PartHavoc::Anything, PartNeutral::Zero};
  case Part::CornerChamfer: // whatever is not modelled is no line, with which a corner is made
  case Part::CornerRadius: return {PartDomain::Value, PartEntry::Neutral, PartHavoc::Neutral, PartNeutral::Vacant};
  case Part::CornerStart: return {PartDomain::Number, PartEntry::Neutral, PartHavoc::Neutral, PartNeutral::Zero};
  case Part::MirrorAt:
  case Part::OtherMapping: return {PartDomain::Value, PartEntry::Neutral, PartHavoc::Mapping, PartNeutral::Vacant};
  case Part::LengthChanged:
  case Part::AxisMoved: return {PartDomain::Truth, PartEntry::Neutral, PartHavoc::Anything, PartNeutral::No};
  case Part::KeptFirst: // like the modes that it belongs to, it is not left behind where there was none
  case Part::KeptSecond:
  case Part::PendingCoordinate: return {PartDomain::Value, PartEntry::Neutral, PartHavoc::Pending, PartNeutral::Vacant};
  case Part::Transformed: return {PartDomain::Truth, PartEntry::Neutral, PartHavoc::Mapping, PartNeutral::No};
  case Part::ModalCallRepeats: return {PartDomain::Number, PartEntry::Neutral, PartHavoc::Anything, PartNeutral::One};
  case Part::ModalCallLocal: return {PartDomain::Value, PartEntry::Neutral, PartHavoc::Anything, PartNeutral::Vacant};
  case Part::OtherModalCalls: return {PartDomain::Truth, PartEntry::Neutral, PartHavoc::Anything, PartNeutral::No};
  case Part::EnteredLoop: return {PartDomain::Truth, PartEntry::Neutral, PartHavoc::Anything, PartNeutral::Yes};
  case Part::Counter: return {PartDomain::Number, PartEntry::Neutral, PartHavoc::Anything, PartNeutral::Zero};
  case Part::SavedCode: return {PartDomain::Code, PartEntry::Neutral, PartHavoc::Anything, PartNeutral::PowerOn};
  case Part::SavedWord: return {PartDomain::Value, PartEntry::Neutral, PartHavoc::Anything, PartNeutral::Vacant};
  case Part::RestoresModes: return {PartDomain::Truth, PartEntry::Neutral, PartHavoc::Anything, PartNeutral::No};
  }
  FEEDHOLD_UNREACHABLE("the switch names every part");
}

constexpr PartDomain domainOf(PartId id) {
  const bool isZeroth = (id.part == Part::LocalVariable || id.part == Part::ModalCallLocal) && id.key == 0;
  return isZeroth ? PartDomain::Vacancy : traitsOf(id.part).domain;
}

/// Calls holds(PartId, part, part...) for each part of one state, or of several that have the same parts, in a fixed
/// order and until it says no.  `skipped` are passed over: the states need not have the same ones.
template <Part... skipped, typename Holds, typename... States> bool everyPart(Holds &&holds, States &...states);
template <Part... skipped, typename Visit, typename... States> void forEachPart(Visit &&visit, States &...states);
/// The parts that are values, of one state: visit(value).
template <typename State, typename Visit> void forEachValue(State &state, Visit &&visit);

/// The same modal calls, whatever they pass.
template <typename R> bool haveSameModalCalls(const MachineState<R> &a, const MachineState<R> &b);
/// The same lists and maps, whatever they hold; variables apart.
template <typename R> bool haveSameLists(const MachineState<R> &a, const MachineState<R> &b);
template <typename R> bool haveSameParts(const MachineState<R> &a, const MachineState<R> &b);

/// Gives both states the same parts.  False when they hold different modal calls: then those are as they were.
template <typename Interpretation, typename R>
bool align(Interpretation &interpretation, MachineState<R> &a, MachineState<R> &b);
/// The same; of different modal calls nothing is known but that there may be some.
template <typename R> void alignToJoin(R &interpretation, MachineState<R> &a, MachineState<R> &b);
/// Of different modal calls none is looked at.
template <typename R> void dropDifferentModalCalls(MachineState<R> &a, MachineState<R> &b);

template <typename R> void setNeutral(R &interpretation, PartId id, typename R::Value &value);
template <typename R> void setNeutral(R &interpretation, PartId id, typename R::Truth &truth);
/// Anything that the part can hold.
template <typename R> void setAnything(R &interpretation, PartId id, typename R::Value &value);
template <typename R> void setAnything(R &interpretation, PartId id, typename R::ModalCode &code);
template <typename R> void setAnything(R &interpretation, PartId id, typename R::Truth &truth);

/// The state in which a program starts: given(PartId, part &) sets what is PartEntry::Given, unknown(PartId, part &)
/// what is PartEntry::Unknown.
template <typename R, typename Interpretation, typename Given, typename Unknown>
MachineState<R> entryParts(Interpretation &interpretation, Given &&given, Unknown &&unknown);

/// What stays as it is although anything else may have happened.
struct HavocKeeps {
  std::optional<std::uint8_t> polarGroup = {}; // polar coordinates are a mapping, too, that only a code tells of
  bool modalCalls = false;                     // the control has none
};
/// Anything may have happened.
template <typename R> void havocParts(R &interpretation, MachineState<R> &state, const HavocKeeps &keeps);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

template <typename T, template <typename> class Of> inline constexpr bool kIsA = false;
template <typename X, template <typename> class Of> inline constexpr bool kIsA<Of<X>, Of> = true;
template <typename T> inline constexpr bool kIsArray = false;
template <typename X, std::size_t size> inline constexpr bool kIsArray<std::array<X, size>> = true;
template <typename T> inline constexpr bool kIsNumberedList = false; // of pairs: number, part
template <typename X> inline constexpr bool kIsNumberedList<std::vector<std::pair<std::uint8_t, X>>> = true;

/// A member of a struct: the part that it is.
template <Part part, typename Member> struct PartMember { Member &member; };
template <Part part, typename Member> PartMember<part, Member> is(Member &member) { return {member}; }
/// A struct that has parts, or a list of such.
template <typename Member> struct NestedMember { Member &member; };
template <typename Member> NestedMember<Member> nested(Member &member) { return {member}; }
/// Tells which parts there are, and is none itself: haveSameParts, align and whoever joins look after it.
struct ShapeMember {};
template <typename Member> ShapeMember shape(Member &) { return {}; }

template <typename Struct> auto membersOf(Struct &whole) {
  using S = std::remove_const_t<Struct>;
  if constexpr (kIsA<S, MachineState>) {
    auto &[locals, variables, havocked, codes, position, words, shift, local, lengthOffset, lengthChanged, axisMoved,
           cycle, transform, corner, kept, transformed, spindle, modalCalls, modalCallsUnknown, enteredLoops, counters,
           savedCodes, savedWords, restoresModes] = whole;
    return std::tuple(
        is<Part::LocalVariable>(locals), is<Part::Variable>(variables), shape(havocked), is<Part::Code>(codes),
        is<Part::Position>(position), is<Part::ModalWord>(words), is<Part::CoordinateShift>(shift),
        is<Part::LocalShift>(local), is<Part::LengthOffset>(lengthOffset), is<Part::LengthChanged>(lengthChanged),
        is<Part::AxisMoved>(axisMoved), nested(cycle), nested(transform), nested(corner), nested(kept),
        is<Part::Transformed>(transformed), is<Part::Spindle>(spindle), nested(modalCalls),
        is<Part::OtherModalCalls>(modalCallsUnknown), is<Part::EnteredLoop>(enteredLoops), is<Part::Counter>(counters),
        is<Part::SavedCode>(savedCodes), is<Part::SavedWord>(savedWords), is<Part::RestoresModes>(restoresModes));
  } else if constexpr (kIsA<S, CycleState>) {
    auto &[bottom, retract, initial, peck, dwell] = whole;
    return std::tuple(is<Part::CycleBottom>(bottom), is<Part::CycleRetract>(retract), is<Part::CycleInitial>(initial),
                      is<Part::CyclePeck>(peck), is<Part::CycleDwell>(dwell));
  } else if constexpr (kIsA<S, TransformState>) {
    auto &[scale, scaleCentre, mirrorAt, angle, centre, pending, other] = whole;
    return std::tuple(is<Part::Scale>(scale), is<Part::ScaleCentre>(scaleCentre), is<Part::MirrorAt>(mirrorAt),
                      is<Part::RotationAngle>(angle), is<Part::RotationCentre>(centre),
                      is<Part::PendingCoordinate>(pending), is<Part::OtherMapping>(other));
  } else if constexpr (kIsA<S, CornerState>) {
    auto &[chamfer, radius, start] = whole;
    return std::tuple(is<Part::CornerChamfer>(chamfer), is<Part::CornerRadius>(radius), is<Part::CornerStart>(start));
  } else if constexpr (kIsA<S, KeptWords>) {
    auto &[first, second] = whole;
    return std::tuple(is<Part::KeptFirst>(first), is<Part::KeptSecond>(second));
  } else {
    static_assert(kIsA<S, ModalCallState>, "a struct of the state without a list of its members");
    auto &[file, call, repeats, locals] = whole;
    return std::tuple(shape(file), shape(call), is<Part::ModalCallRepeats>(repeats), is<Part::ModalCallLocal>(locals));
  }
}

template <Part... skipped, typename Holds, typename... Structs> bool everyPartOf(Holds &holds, Structs &...structs);

template <Part... skipped, typename Holds, typename... Same> bool everyPartOfMember(Holds &, ShapeMember, Same...) {
  return true;
}

template <Part... skipped, typename Holds, typename First, typename... Others>
bool everyPartOfMember(Holds &holds, NestedMember<First> first, NestedMember<Others>... others) {
  if constexpr (requires { first.member.begin(); }) {
    for (std::size_t i = 0; i < first.member.size(); ++i)
      if (!everyPartOf<skipped...>(holds, first.member[i], others.member[i]...))
        return false;
    return true;
  } else {
    return everyPartOf<skipped...>(holds, first.member, others.member...);
  }
}

template <Part... skipped, typename Holds, Part part, typename First, typename... Others>
bool everyPartOfMember(Holds &holds, PartMember<part, First> first, PartMember<part, Others>... others) {
  using Member = std::remove_const_t<First>;
  if constexpr (((part == skipped) || ...)) {
    return true;
  } else if constexpr (kIsA<Member, VariableMap>) {
    for (std::size_t i = 0; i < first.member.entries().size(); ++i)
      if (!holds(PartId{part, first.member.entries()[i].first}, first.member.entries()[i].second,
                 others.member.entries()[i].second...))
        return false;
    return true;
  } else if constexpr (kIsNumberedList<Member>) {
    for (std::size_t i = 0; i < first.member.size(); ++i)
      if (!holds(PartId{part, first.member[i].first}, first.member[i].second, others.member[i].second...))
        return false;
    return true;
  } else if constexpr (kIsArray<Member> || requires { first.member.begin(); }) {
    for (std::uint32_t i = 0; i < first.member.size(); ++i)
      if (!holds(PartId{part, i}, first.member[i], others.member[i]...))
        return false;
    return true;
  } else {
    return holds(PartId{part}, first.member, others.member...);
  }
}

template <Part... skipped, typename Holds, typename... Structs> bool everyPartOf(Holds &holds, Structs &...structs) {
  using Members = std::tuple_element_t<0, std::tuple<decltype(membersOf(structs))...>>;
  const auto walk = [&holds]<std::size_t... index>(std::index_sequence<index...>, auto &&...members) {
    const auto one = [&]<std::size_t at>(std::integral_constant<std::size_t, at>) {
      return everyPartOfMember<skipped...>(holds, std::get<at>(members)...);
    };
    return (one(std::integral_constant<std::size_t, index>{}) && ...);
  };
  return walk(std::make_index_sequence<std::tuple_size_v<Members>>{}, membersOf(structs)...);
}

template <typename List> bool haveSameNumbers(const List &a, const List &b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto &x, const auto &y) { return x.first == y.first; });
}

/// What is saved in one of two states may be anything in the other.
template <typename Interpretation, typename List>
void completeSaved(Interpretation &interpretation, Part part, List &to, const List &from) {
  for (const auto &[number, saved] : from) {
    const auto at = std::ranges::lower_bound(to, number, {}, [](const auto &entry) { return entry.first; });
    if (at == to.end() || at->first != number)
      setAnything(interpretation, {part, number}, to.emplace(at, number, std::decay_t<decltype(saved)>())->second);
  }
}

/// A loop that is not listed has been entered, a counter that is not there counts nothing.
template <typename Interpretation, typename R>
void completeLists(Interpretation &interpretation, MachineState<R> &to, const MachineState<R> &from) {
  to.variables.addKeysOf(from.variables, [&](std::uint32_t number) { return interpretation.unwritten(to, number); });
  for (const auto &[number, entered] : from.enteredLoops) {
    typename R::Truth neutral;
    setNeutral(interpretation, {Part::EnteredLoop, number}, neutral);
    enteredLoop(to, number, neutral);
  }
  while (to.counters.size() < from.counters.size())
    setNeutral(interpretation, {Part::Counter}, to.counters.emplace_back());
  completeSaved(interpretation, Part::SavedCode, to.savedCodes, from.savedCodes);
  completeSaved(interpretation, Part::SavedWord, to.savedWords, from.savedWords);
}

} // namespace detail

template <Part... skipped, typename Holds, typename... States> bool everyPart(Holds &&holds, States &...states) {
  return detail::everyPartOf<skipped...>(holds, states...);
}

template <Part... skipped, typename Visit, typename... States> void forEachPart(Visit &&visit, States &...states) {
  const auto visits = [&visit](PartId id, auto &...parts) {
    visit(id, parts...);
    return true;
  };
  detail::everyPartOf<skipped...>(visits, states...);
}

template <typename State, typename Visit> void forEachValue(State &state, Visit &&visit) {
  forEachPart(
      [&visit](PartId, auto &part) {
        if constexpr (std::is_same_v<std::remove_const_t<std::remove_reference_t<decltype(part)>>,
                                     typename State::Value>)
          visit(part);
      },
      state);
}

template <typename R> bool haveSameModalCalls(const MachineState<R> &a, const MachineState<R> &b) {
  return std::equal(a.modalCalls.begin(), a.modalCalls.end(), b.modalCalls.begin(), b.modalCalls.end(),
                    [](const auto &x, const auto &y) { return x.file == y.file && x.call == y.call; });
}

template <typename R> bool haveSameLists(const MachineState<R> &a, const MachineState<R> &b) {
  return a.counters.size() == b.counters.size() && detail::haveSameNumbers(a.enteredLoops, b.enteredLoops) &&
         detail::haveSameNumbers(a.savedCodes, b.savedCodes) && detail::haveSameNumbers(a.savedWords, b.savedWords) &&
         haveSameModalCalls(a, b);
}

template <typename R> bool haveSameParts(const MachineState<R> &a, const MachineState<R> &b) {
  return haveSameLists(a, b) && detail::haveSameNumbers(a.variables.entries(), b.variables.entries());
}

template <typename Interpretation, typename R>
bool align(Interpretation &interpretation, MachineState<R> &a, MachineState<R> &b) {
  if (haveSameParts(a, b))
    return true;
  detail::completeLists(interpretation, a, b);
  detail::completeLists(interpretation, b, a);
  return haveSameModalCalls(a, b);
}

template <typename R> void alignToJoin(R &interpretation, MachineState<R> &a, MachineState<R> &b) {
  if (align(interpretation, a, b))
    return;
  dropDifferentModalCalls(a, b);
  setAnything(interpretation, {Part::OtherModalCalls}, a.modalCallsUnknown);
  b.modalCallsUnknown = a.modalCallsUnknown;
}

template <typename R> void dropDifferentModalCalls(MachineState<R> &a, MachineState<R> &b) {
  if (haveSameModalCalls(a, b))
    return;
  a.modalCalls.clear();
  b.modalCalls.clear();
}

template <typename R> void setNeutral(R &interpretation, PartId id, typename R::Value &value) {
  const PartNeutral neutral = traitsOf(id.part).neutral;
  value = neutral == PartNeutral::Vacant ? interpretation.vacant()
                                         : interpretation.number(neutral == PartNeutral::One ? 1 : 0);
}
template <typename R> void setNeutral(R &interpretation, PartId id, typename R::Truth &truth) {
  truth = interpretation.truth(traitsOf(id.part).neutral == PartNeutral::Yes);
}

template <typename R> void setAnything(R &interpretation, PartId id, typename R::Value &value) {
  switch (domainOf(id)) {
  case PartDomain::Vacancy: value = interpretation.vacant(); break;
  case PartDomain::Number: value = interpretation.anyNumber(); break;
  case PartDomain::Value: value = interpretation.anything(); break;
  case PartDomain::Code:
  case PartDomain::Truth: FEEDHOLD_UNREACHABLE("a part that is no value");
  }
}
template <typename R> void setAnything(R &interpretation, PartId, typename R::ModalCode &code) {
  code = interpretation.unknownCode();
}
template <typename R> void setAnything(R &interpretation, PartId, typename R::Truth &truth) {
  truth = interpretation.unknownTruth();
}

template <typename R, typename Interpretation, typename Given, typename Unknown>
MachineState<R> entryParts(Interpretation &interpretation, Given &&given, Unknown &&unknown) {
  MachineState<R> state;
  forEachPart(
      [&](PartId id, auto &part) {
        switch (traitsOf(id.part).entry) {
        case PartEntry::Given: return given(id, part);
        case PartEntry::Unknown: return unknown(id, part);
        case PartEntry::Neutral:
          if constexpr (requires { setNeutral(interpretation, id, part); })
            return setNeutral(interpretation, id, part);
          FEEDHOLD_UNREACHABLE("a code is given");
        }
      },
      state);
  return state;
}

template <typename R> void havocParts(R &interpretation, MachineState<R> &state, const HavocKeeps &keeps) {
  const bool isMapped = interpretation.mayBe(state.transformed);
  interpretation.havocVariables(state, 0, 0xffffffff); // which leaves none of them in the state
  forEachPart<Part::Variable>(
      [&](PartId id, auto &part) {
        if (!isMapped && id == PartId{Part::Code, keeps.polarGroup.value_or(kModalGroups)})
          return;
        if (keeps.modalCalls && id == PartId{Part::OtherModalCalls})
          return;
        if constexpr (requires { setNeutral(interpretation, id, part); })
          if (traitsOf(id.part).havoc == PartHavoc::Neutral ||
              (!isMapped && traitsOf(id.part).havoc == PartHavoc::Mapping))
            return setNeutral(interpretation, id, part);
        if constexpr (requires { interpretation.isVacant(part); })
          if (!isMapped && traitsOf(id.part).havoc == PartHavoc::Pending &&
              !interpretation.mayBe(interpretation.negation(interpretation.isVacant(part))))
            return;
        setAnything(interpretation, id, part);
      },
      state);
}

} // namespace feedhold
