#include "meaning/machine/cutter_block.h"

#include "meaning/semantics/cycles.h"

#include <algorithm>
#include <cmath>

namespace feedhold {

namespace {

using Context = StepContext<ConcreteInterpretation>;
using Words = ExecutedWords<ConcreteInterpretation>;

/// What may stand in a block between start-up and cancel; all else is not followed there: its own movements, another
/// tool length (a change of the offset for FANUC), another zero point, mappings, units, cycles.
bool isHarmless(CodeAction action) {
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

bool setsSide(const Code &code) {
  return code.action == CodeAction::CompensationLeft || code.action == CodeAction::CompensationRight;
}
bool isArcInForce(Context &context) {
  return context.inForce(ModalKind::Motion, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}, false);
}

std::string_view whyForeign(Context &context, const Words &words) {
  if (words.unmodelled || words.mayTakeAxes)
    return "cutter compensation through a block that is not modelled";
  for (const CodeWord &word : words.codes) {
    if (!isHarmless(word.code->action))
      return "cutter compensation through a code that changes coordinates, offsets or the path";
    if (setsSide(*word.code) && !isArcInForce(context) && (words.find('I') || words.find('J') || words.find('K')))
      return "cutter compensation that is given its vector by I, J, K";
  }
  const auto group = context.modes.groupOf(ModalKind::Cycle);
  if (group && context.interpretation.isOneOf(context.state.codes[*group],
                                              context.modes.maskOf(ModalKind::Cycle, kDrillingCycles)))
    return "cutter compensation in a canned cycle";
  return {};
}

/// The code of the group that is in force.
const Code *compensationCode(Context &context) {
  const auto group = context.modes.groupOf(ModalKind::Compensation);
  if (!group)
    return nullptr;
  const auto &codes = context.modes.group(*group).codes;
  const std::uint8_t index = context.state.codes[*group];
  return index < codes.size() ? codes[index] : nullptr;
}

class OffsetReader {
public:
  explicit OffsetReader(Context &context) : context_(context) {}

  /// Of D `number`; a radius.  Absent: no variable gives it.
  std::optional<double> read(std::uint32_t number) const {
    const CutterOffsets &offsets = context_.behaviour().cutterOffsets;
    if (number > offsets.count)
      return std::nullopt;
    const auto geometry = firstGiven(offsets.geometry, number);
    const auto wear = firstGiven(offsets.wear, number);
    if (!geometry && !wear)
      return std::nullopt;
    const double sum = geometry.value_or(0) + wear.value_or(0);
    return context_.isOn(context_.dialect().switches.odi) ? sum / 2 : sum;
  }

private:
  std::optional<double> firstGiven(const std::array<std::uint32_t, 2> &firsts, std::uint32_t number) const {
    for (const std::uint32_t first : firsts)
      if (first != 0)
        if (const ConcreteValue *value = cellValue(first + number - 1))
          return value->vacant ? 0 : value->number;
    return std::nullopt;
  }
  const ConcreteValue *cellValue(std::uint32_t variable) const {
    const std::uint32_t cell = cellOf(context_.dialect(), variable);
    if (const ConcreteValue *written = context_.state.variables.find(cell))
      return written;
    for (const auto &[given, value] : context_.interpretation.allGiven())
      if (given == cell)
        return &value;
    return nullptr;
  }

  Context &context_;
};

constexpr std::string_view kNoNumber = "cutter compensation without a D that is known";
constexpr std::string_view kNoOffset = "cutter compensation by an offset that is not given (give it by --offset D1=5)";

/// Takes down side and radius; what is in force is G41 or G42.
void readSide(Context &context, const Words &words, const Code &code,
              const std::function<std::optional<double>()> &otherwise, CutterBlock &block) {
  CutterSide side{code.action == CodeAction::CompensationLeft ? 1 : -1, 0};
  const ConcreteValue &word = context.state.word('D');
  const auto &byDiameter = context.behaviour().cutterDiameterCodes;
  const bool isDiameter = std::find(byDiameter.begin(), byDiameter.end(), code.tenths) != byDiameter.end();
  std::optional<double> offset;
  if (isDiameter && !(block.switches && !words.find('D')))
    offset = word.number / 2;
  else if (word.vacant)
    block.whyNoRadius = kNoNumber;
  else if (word.number == 0)
    return; // D0: as without compensation
  else if (word.number > 0 && word.number < 1e6)
    offset = OffsetReader(context).read(static_cast<std::uint32_t>(word.number));
  if (!offset && block.whyNoRadius.empty()) {
    offset = otherwise();
    block.offsetIsAssumed = offset.has_value();
  }
  if (!offset && block.whyNoRadius.empty())
    block.whyNoRadius = kNoOffset;
  if (offset && *offset < 0)
    side.sign = -side.sign;
  side.radius = std::abs(offset.value_or(0));
  if (circleMappingOf(context, block.plane).turnsOver)
    side.sign = -side.sign;
  block.side = side;
}

} // namespace

bool mayCompensate(Context &context) {
  return !context.inForce(ModalKind::Compensation, {CodeAction::CompensationOff}, true);
}

CutterBlock cutterBlockOf(Context &context, const Words &words,
                          const std::function<std::optional<double>()> &otherwise) {
  CutterBlock block{};
  block.foreign = whyForeign(context, words);
  for (const CodeWord &word : words.codes) {
    block.switches = block.switches || setsSide(*word.code);
    block.stopsReading = block.stopsReading || word.code->role == CodeRole::ProgramStop;
  }
  if (const auto plane = planeOf(context))
    block.plane = *plane;
  block.namesPlane = !words.has(CodeAction::Dwell) &&
                     (words.find(letterOf(block.plane.first)) || words.find(letterOf(block.plane.second)));
  const Code *code = compensationCode(context);
  if (code != nullptr && setsSide(*code)) {
    readSide(context, words, *code, otherwise, block);
  } else if (mayCompensate(context)) {
    block.side = CutterSide{};
    block.whyNoRadius = "compensation by a code that is not followed";
  }
  if (context.dialect().machine == MachineKind::Turning)
    block.whyNoRadius = "tool nose radius compensation";
  return block;
}

} // namespace feedhold
