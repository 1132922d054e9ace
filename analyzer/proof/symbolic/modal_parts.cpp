#include "proof/symbolic/modal_parts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

namespace feedhold::prove {

using smt::TermId;

std::string nameOfPart(PartId id) {
  switch (id.part) {
  case Part::Code: return "modal G codes";
  case Part::ModalWord: return std::string(1, kModalWords[id.key]);
  case Part::CoordinateShift: return "the G92 offset";
  case Part::LocalShift: return "the G52 offset";
  case Part::LengthOffset: return "the tool length offset";
  case Part::Spindle: return "the spindle";
  case Part::CycleBottom:
  case Part::CycleRetract:
  case Part::CycleInitial:
  case Part::CyclePeck:
  case Part::CycleDwell: return "the words of a canned cycle";
  case Part::Scale:
  case Part::ScaleCentre:
  case Part::MirrorAt:
  case Part::RotationAngle:
  case Part::RotationCentre:
  case Part::OtherMapping:
  case Part::PendingCoordinate:
  case Part::Transformed: return "mirror, scaling and rotation";
  case Part::ModalCallRepeats:
  case Part::ModalCallLocal:
  case Part::OtherModalCalls: return "the modal call";
  case Part::LocalVariable:
  case Part::Variable:
  case Part::Position:
  case Part::KeptFirst: // of the position
  case Part::KeptSecond:
  case Part::LengthChanged:
  case Part::AxisMoved:
  case Part::CornerChamfer: // at the end none waits
  case Part::CornerRadius:
  case Part::CornerStart:
  case Part::EnteredLoop:
  case Part::Counter:
  case Part::SavedCode:
  case Part::SavedWord:
  case Part::RestoresModes: return "";
  }
  FEEDHOLD_UNREACHABLE("the switch names every part");
}

namespace {

/// Parts that take effect only while a code of their group is active.
TermId isUsed(SymbolicInterpretation &interpretation, const ModalTable &modes, PartId id, const SymbolicState &state) {
  smt::TermStore &store = interpretation.store();
  /// Absent: the control has no such code.
  const auto isInForce = [&](ModalKind kind, CodeAction action) -> std::optional<TermId> {
    const auto group = modes.groupOf(kind);
    const CodeMask mask = modes.maskOf(kind, {action});
    if (!group || mask == 0)
      return std::nullopt;
    TermId isOne = store.no();
    for (CodeMask left = mask; left != 0; left &= left - 1)
      isOne = store.logicalOr(
          isOne, store.equal(state.codes[*group].index,
                             interpretation.code(static_cast<std::uint8_t>(std::countr_zero(left))).index));
    return isOne;
  };
  const auto unless = [&](ModalKind kind, CodeAction cancel) {
    const auto cancelled = isInForce(kind, cancel);
    return cancelled ? store.logicalNot(*cancelled) : store.yes();
  };
  constexpr std::array kOfCycle = {Part::CycleBottom, Part::CycleRetract, Part::CycleInitial, Part::CyclePeck,
                                   Part::CycleDwell};
  if (std::find(kOfCycle.begin(), kOfCycle.end(), id.part) != kOfCycle.end())
    return unless(ModalKind::Cycle, CodeAction::CycleOff);
  if (id.part == Part::LengthOffset)
    return unless(ModalKind::Length, CodeAction::LengthOff);
  if (id.part == Part::ModalWord && kModalWords[id.key] == 'P')
    return isInForce(ModalKind::WorkOffset, CodeAction::ExtendedWorkOffset).value_or(store.no());
  const bool isCentre = id.part == Part::ScaleCentre || id.part == Part::RotationCentre;
  return isCentre ? store.no() : store.yes(); // an active mapping shows in its scale and its angle
}

/// Calls visit(part, before, now) for each part that the clause speaks of; both states have the same parts.
template <typename Visit>
void forEachModalPart(const ModalTable &modes, const ModalPreserved &clause, SymbolicState &before, SymbolicState &now,
                      Visit visit) {
  forEachPart<Part::LocalVariable, Part::Variable, Part::Position, Part::KeptFirst, Part::KeptSecond,
              Part::LengthChanged, Part::AxisMoved, Part::EnteredLoop, Part::Counter, Part::SavedCode, Part::SavedWord,
              Part::RestoresModes>(
      [&](PartId id, auto &a, auto &b) {
        const bool isNoGroup = id.part == Part::Code && (id.key == 0 || modes.group(id.key).codes.empty());
        const bool isExcepted =
            id.part == Part::ModalWord && clause.except.find(kModalWords[id.key]) != std::string::npos;
        if (!isNoGroup && !isExcepted)
          visit(id, a, b);
      },
      before, now);
}

} // namespace

std::vector<ModalPart> modalParts(SymbolicInterpretation &interpretation, const Dialect &dialect,
                                  const ModalPreserved &clause, SymbolicState before, SymbolicState now) {
  smt::TermStore &store = interpretation.store();
  std::vector<ModalPart> parts;
  if (!alignAll(interpretation, before, now))
    parts.push_back({PartId{Part::OtherModalCalls}, store.no()});
  dropDifferentModalCalls(before, now);
  const ModalTable modes(dialect);
  const auto equal = Overloaded{
      [&](const SymbolicValue &a, const SymbolicValue &b) {
        return store.logicalAnd(store.equal(a.vacant, b.vacant),
                                store.logicalOr(a.vacant, store.equal(a.number, b.number)));
      },
      [&](const SymbolicCode &a, const SymbolicCode &b) { return store.equal(a.index, b.index); },
      [&](const Condition &a, const Condition &b) { return store.ite(a.term, b.term, store.logicalNot(b.term)); }};
  forEachModalPart(modes, clause, before, now, [&](PartId id, const auto &a, const auto &b) {
    parts.push_back({id, store.implies(isUsed(interpretation, modes, id, now), equal(a, b))});
  });
  return parts;
}

void keepModalState(SymbolicInterpretation &interpretation, const Dialect &dialect, const ModalPreserved &clause,
                    SymbolicState before, SymbolicState &now) {
  if (!haveSameLists(before, now))
    return;
  smt::TermStore &store = interpretation.store();
  const ModalTable modes(dialect);
  const auto keep = [&](TermId used) {
    return Overloaded{
        [&, used](const SymbolicValue &a, SymbolicValue &b) { b = interpretation.select({used}, a, b); },
        [&, used](const SymbolicCode &a, SymbolicCode &b) { b = interpretation.selectCode({used}, a, b); },
        [&, used](const Condition &a, Condition &b) { b.term = store.ite(used, a.term, b.term); }};
  };
  forEachModalPart(modes, clause, before, now, [&](PartId id, const auto &a, auto &b) { // codes before what they use
    if (id.part != Part::PendingCoordinate && !nameOfPart(id).empty())
      keep(isUsed(interpretation, modes, id, now))(a, b);
  });
}

} // namespace feedhold::prove
