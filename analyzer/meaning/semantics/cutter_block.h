// CutterBlock: what an executed block is to cutter compensation.
#pragma once

#include "meaning/semantics/cutter_geometry.h"
#include "meaning/semantics/cutter_offset.h"
#include "meaning/semantics/cycles.h"
#include "meaning/semantics/executed_words.h"
#include "meaning/semantics/turret.h"
#include "meaning/semantics/waiting_corner.h"

#include <algorithm>
#include <string_view>

namespace feedhold {

template <typename N> struct CutterBlock {
  /// The codes and D ask for compensation on this side, seen along the path as the machine makes it (mirror images
  /// swap the sides; so does a radius below 0, which is positive then); absent: none.  Radius 0 where `whyNoRadius`.
  std::optional<CutterSide<N>> side;
  std::string_view whyNoRadius = {}; // the offset is not known; empty: it is
  bool offsetIsAssumed = false;
  CutterPlane plane = {};
  bool switches = false;         // G41 or G42 stands in the block
  bool isInCompensation = false; // G41 or G42 may be in force
  bool changesTip = false;       // on a lathe, by a T word: another tool, or another offset
  /// Of a cycle that takes the offset of D itself (circle_pocket.h): what it is; empty: the block is none.
  std::string_view pocket = {};
  bool stopsReading = false;
  bool namesPlane = false;      // has words for the axes of the plane
  bool leadsToCorner = false;   // its line waits for the next one (corners.h), which tells its moves, too
  bool cancelsByVector = false; // `G40 I10. J-10.`: the block before it ends where the two directions cross
  /// Why the block is not followed where the compensation is in force; empty: it is.
  std::string_view foreign = {};
};

/// The host (cutter_geometry.h) also has
///
///   offsetOf(context, value)  by that of D a radius of either sign, on a lathe by that of T radius and tip; absent,
///                             whyNoOffset() or kNoNose: nothing gives it
template <typename Host>
CutterBlock<typename Host::Length> cutterBlockOf(Host &host, StepContext<typename Host::Interpretation> &context,
                                                 const ExecutedWords<typename Host::Interpretation> &words);

/// G41 or G42 is in force, or a code of their group that is not followed.
template <ValueAlgebra R> bool mayCompensate(StepContext<R> &context) {
  return !context.certain(
      context.inForce(ModalKind::Compensation, {CodeAction::CompensationOff}, context.interpretation.truth(true)));
}

/// The code of a cycle that takes the offset of D itself; null: there is none in the block.
template <ValueAlgebra R> const Code *findPocket(const ExecutedWords<R> &words) {
  const auto pocket = std::ranges::find_if(
      words.codes, [](const CodeWord &word) { return word.address == 'G' && isCirclePocket(word.code->action); });
  return pocket == words.codes.end() ? nullptr : pocket->code;
}

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

/// What may stand in a block between start-up and cancel; all else is not followed there: its own movements, another
/// tool length (a change of the offset for FANUC), another zero point, mappings, units, cycles.
inline bool isHarmlessForCutter(CodeAction action) {
  constexpr std::array kHarmless = {CodeAction::Rapid,           CodeAction::Linear,
                                    CodeAction::ArcClockwise,    CodeAction::ArcCounterclockwise,
                                    CodeAction::Dwell,           CodeAction::CycleOff,
                                    CodeAction::PlaneXY,         CodeAction::PlaneZX,
                                    CodeAction::PlaneYZ,         CodeAction::Absolute,
                                    CodeAction::Incremental,     CodeAction::ArcAbsolute,
                                    CodeAction::ArcIncremental,  CodeAction::FeedPerMinute,
                                    CodeAction::FeedInverse,     CodeAction::FeedPerRevolution,
                                    CodeAction::CompensationOff, CodeAction::CompensationLeft,
                                    CodeAction::ReturnToInitial, CodeAction::CompensationRight,
                                    CodeAction::ReturnToR,       CodeAction::SpindleClockwise,
                                    CodeAction::ConstantSpeed,   CodeAction::SpindleCounterclockwise,
                                    CodeAction::ConstantSurface, CodeAction::SpindleStop,
                                    CodeAction::CoolantOn,       CodeAction::CoolantOff};
  return changesNothing(action) || std::find(kHarmless.begin(), kHarmless.end(), action) != kHarmless.end();
}
inline bool setsSide(const Code &code) {
  return code.action == CodeAction::CompensationLeft || code.action == CodeAction::CompensationRight;
}

template <typename R> bool hasVector(const ExecutedWords<R> &words) {
  return words.find('I') || words.find('J') || words.find('K');
}

template <ValueAlgebra R> std::string_view whyForeign(StepContext<R> &context, const ExecutedWords<R> &words) {
  if (words.unmodelled || !words.unlisted.empty() || words.mayTakeAxes || !words.computed.empty())
    return "cutter compensation through a block that is not modelled";
  R &interpretation = context.interpretation;
  const bool mayBeArc = interpretation.mayBe(context.inForce(
      ModalKind::Motion, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}, interpretation.truth(false)));
  for (const CodeWord &word : words.codes) {
    if (!isHarmlessForCutter(word.code->action))
      return "cutter compensation through a code that changes coordinates, offsets or the path";
    if (setsSide(*word.code) && !mayBeArc && hasVector(words))
      return "cutter compensation that is given its vector by I, J, K";
  }
  if (hasTurret(context) && words.find('T'))
    return "tool nose radius compensation through another tool or tool offset";
  // The cycles of a lathe are codes of motion, which stay in force for blocks that have none.
  if (hasTurret(context) &&
      !context.certain(context.inForce(
          ModalKind::Motion,
          {CodeAction::Rapid, CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise},
          interpretation.truth(true))))
    return "tool nose radius compensation through a cycle or a thread";
  const auto group = context.modes.groupOf(ModalKind::Cycle);
  if (group && interpretation.mayBe(interpretation.isOneOf(context.state.codes[*group],
                                                           context.modes.maskOf(ModalKind::Cycle, kDrillingCycles))))
    return "cutter compensation in a canned cycle";
  return {};
}

/// The code of the group that is in force; null: it may be several.
template <ValueAlgebra R> const Code *compensationCode(StepContext<R> &context) {
  const auto group = context.modes.groupOf(ModalKind::Compensation);
  const auto index = group ? context.interpretation.onlyCode(context.state.codes[*group]) : std::nullopt;
  if (!index)
    return nullptr;
  const auto &codes = context.modes.group(*group).codes;
  return *index < codes.size() ? codes[*index] : nullptr;
}

inline constexpr std::string_view kNoCutterNumber = "cutter compensation without a D that is known";

/// Takes down side and radius; what is in force is G41 or G42.
template <typename Host>
void readSide(Host &host, StepContext<typename Host::Interpretation> &context,
              const ExecutedWords<typename Host::Interpretation> &words, const Code &code,
              CutterBlock<typename Host::Length> &block) {
  using N = typename Host::Length;
  auto &interpretation = context.interpretation;
  CutterSide<N> side{code.action == CodeAction::CompensationLeft ? 1 : -1, {}};
  const auto &word = context.state.word('D');
  const auto &byDiameter = context.behaviour().cutterDiameterCodes;
  const bool isDiameter = std::find(byDiameter.begin(), byDiameter.end(), code.tenths) != byDiameter.end();
  std::optional<CutterOffset<N>> offset;
  if (isDiameter && !(block.switches && !words.find('D')))
    offset = CutterOffset<N>{host.quotient(host.lengthOf(word), host.number(2))};
  else if (host.holds(interpretation.isVacant(word)))
    block.whyNoRadius = kNoCutterNumber;
  else if (host.holds(host.none(host.lengthOf(word), 0)))
    return; // D0: as without compensation
  else
    offset = host.offsetOf(context, word);
  if (!offset && block.whyNoRadius.empty())
    block.whyNoRadius = host.whyNoOffset();
  if (offset) {
    block.offsetIsAssumed = offset->isAssumed;
    const std::optional<int> sign = host.signOf(offset->radius);
    side.radius = withSign(sign.value_or(1), offset->radius);
    side.sign *= sign.value_or(1);
    side.isOfEitherSign = !sign;
  }
  if (host.holds(circleMappingOf(context, block.plane.axes).turnsOver))
    side.sign = -side.sign;
  block.side = side;
}

inline constexpr std::string_view kNoseBesidePlane = "tool nose radius compensation outside of the plane of X and Z";
inline constexpr std::string_view kNoTip =
    "tool nose radius compensation without a tool offset that is known to be in force";
inline constexpr std::string_view kMirroredNose = "tool nose radius compensation under mirror image";
inline constexpr std::string_view kNegativeNose = "tool nose radius compensation by a radius below 0";

/// The same for a lathe, whose radius and tip belong to the tool offset.  With X up and Z to the right G41 goes on the
/// left: from Z towards X is counterclockwise, as for arcs of G18 (FANUC B-63944EN-1/02, tool nose radius
/// compensation, "offset direction").
template <typename Host>
void readNose(Host &host, StepContext<typename Host::Interpretation> &context, const Code &code,
              CutterBlock<typename Host::Length> &block) {
  using N = typename Host::Length;
  block.side = CutterSide<N>{code.action == CodeAction::CompensationLeft ? 1 : -1, {}};
  block.plane.byDiameter = true;
  if (!planeOf(context) || block.plane.axes.normal != Axis::Y)
    block.whyNoRadius = kNoseBesidePlane;
  else if (!host.holds(tipIsKnown(context)))
    block.whyNoRadius = kNoTip;
  else if (host.holds(circleMappingOf(context, block.plane.axes).turnsOver))
    block.whyNoRadius = kMirroredNose;
  if (!block.whyNoRadius.empty())
    return;
  const auto nose = host.offsetOf(context, context.state.word('T'));
  if (!nose)
    block.whyNoRadius = Host::kNoNose;
  else if (host.holds(host.negative(nose->radius, 0)))
    block.whyNoRadius = kNegativeNose;
  if (!block.whyNoRadius.empty())
    return;
  const auto along = [&](int direction) { return direction == 0 ? N{} : withSign(direction, nose->radius); };
  block.side->radius = nose->radius;
  block.side->tip = {along(nose->tip.z), along(nose->tip.x)};
}

} // namespace detail

template <typename Host>
CutterBlock<typename Host::Length> cutterBlockOf(Host &host, StepContext<typename Host::Interpretation> &context,
                                                 const ExecutedWords<typename Host::Interpretation> &words) {
  using N = typename Host::Length;
  CutterBlock<N> block{};
  block.foreign = detail::whyForeign(context, words);
  for (const CodeWord &word : words.codes) {
    block.switches = block.switches || detail::setsSide(*word.code);
    block.cancelsByVector =
        block.cancelsByVector || (word.code->action == CodeAction::CompensationOff && detail::hasVector(words));
    block.stopsReading = block.stopsReading || word.code->role == CodeRole::ProgramStop;
  }
  block.leadsToCorner = context.interpretation.mayBe(waitsForLine(context));
  const auto plane = planeOf(context);
  if (plane)
    block.plane.axes = *plane;
  const bool isLathe = hasTurret(context);
  block.changesTip = isLathe && words.find('T');
  block.namesPlane = !words.has(CodeAction::Dwell) &&
                     (words.find(letterOf(block.plane.axes.first)) || words.find(letterOf(block.plane.axes.second)) ||
                      (isLathe && (words.find('U') || words.find('W'))));
  const Code *code = detail::compensationCode(context);
  block.isInCompensation = mayCompensate(context);
  if (const Code *pocket = findPocket(words)) {
    block.pocket = pocket->meaning;
    detail::readSide(host, context, words, *pocket, block);
  } else if (code != nullptr && detail::setsSide(*code)) {
    if (isLathe)
      detail::readNose(host, context, *code, block);
    else
      detail::readSide(host, context, words, *code, block);
  } else if (block.isInCompensation) {
    block.side = CutterSide<N>{};
    block.whyNoRadius = "compensation by a code that is not followed";
  }
  return block;
}

} // namespace feedhold
