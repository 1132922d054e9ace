#include "meaning/semantics/modal_table.h"

#include <algorithm>

namespace feedhold {

namespace {

struct KindRow {
  ModalKind kind;
  std::string_view name;
  CodeAction sample; // the group of this code is the group of the kind
};

constexpr std::array<KindRow, kModalKinds> kKinds = {{
    {ModalKind::Motion, "motion", CodeAction::Linear},
    {ModalKind::Plane, "plane", CodeAction::PlaneXY},
    {ModalKind::Distance, "distance", CodeAction::Absolute},
    {ModalKind::ArcDistance, "arc distance", CodeAction::ArcIncremental},
    {ModalKind::FeedMode, "feed mode", CodeAction::FeedPerRevolution},
    {ModalKind::Units, "units", CodeAction::Metric},
    {ModalKind::Compensation, "cutter compensation", CodeAction::CompensationOff},
    {ModalKind::Length, "tool length", CodeAction::LengthOff},
    {ModalKind::Cycle, "canned cycle", CodeAction::CycleOff},
    {ModalKind::ReturnLevel, "return level", CodeAction::ReturnToR},
    {ModalKind::Scaling, "scaling", CodeAction::ScalingOff},
    {ModalKind::ModalCall, "modal call", CodeAction::Unclassified},
    {ModalKind::Spindle, "spindle mode", CodeAction::ConstantSpeed},
    {ModalKind::WorkOffset, "work offset", CodeAction::WorkOffset},
    {ModalKind::Rotation, "rotation", CodeAction::RotationOff},
    {ModalKind::Polar, "polar", CodeAction::PolarOff},
    {ModalKind::Mirror, "mirror", CodeAction::MirrorOff},
}};

// FANUC parameter 3402 and the reset state that its manual names; a lathe starts in ZX with feed per revolution.
constexpr std::array kPowerOnActions = {
    CodeAction::Rapid,         CodeAction::PlaneXY,         CodeAction::Absolute,        CodeAction::ArcIncremental,
    CodeAction::FeedPerMinute, CodeAction::Metric,          CodeAction::CompensationOff, CodeAction::LengthOff,
    CodeAction::CycleOff,      CodeAction::ReturnToInitial, CodeAction::ScalingOff,      CodeAction::ConstantSpeed,
    CodeAction::WorkOffset,    CodeAction::RotationOff,     CodeAction::PolarOff,        CodeAction::MirrorOff,
};
constexpr std::array kPowerOnTurning = {CodeAction::PlaneZX, CodeAction::FeedPerRevolution};

} // namespace

std::string_view nameOf(ModalKind kind) { return kKinds[static_cast<std::size_t>(kind)].name; }

bool isWholeMode(CodeAction action) {
  constexpr std::array kWhole = {
      CodeAction::Rapid,           CodeAction::Linear,
      CodeAction::ArcClockwise,    CodeAction::ArcCounterclockwise,
      CodeAction::PlaneXY,         CodeAction::PlaneZX,
      CodeAction::PlaneYZ,         CodeAction::Absolute,
      CodeAction::Incremental,     CodeAction::ArcAbsolute,
      CodeAction::ArcIncremental,  CodeAction::Inch,
      CodeAction::Metric,          CodeAction::FeedInverse,
      CodeAction::FeedPerMinute,   CodeAction::FeedPerRevolution,
      CodeAction::CompensationOff, CodeAction::CycleOff,
      CodeAction::ReturnToInitial, CodeAction::ReturnToR,
      CodeAction::WorkOffset,
  };
  return std::find(kWhole.begin(), kWhole.end(), action) != kWhole.end();
}

ModalTable::ModalTable(const Dialect &dialect) {
  for (const Code &code : dialect.gCodes) {
    if (code.group == 0 || code.group >= kModalGroups || groups_[code.group].codes.size() >= 64)
      continue;
    groups_[code.group].codes.push_back(&code);
    for (const KindRow &row : kKinds)
      if (row.sample != CodeAction::Unclassified && code.action == row.sample)
        kinds_[static_cast<std::size_t>(row.kind)] = code.group;
    if (code.role == CodeRole::ModalCallCancel)
      kinds_[static_cast<std::size_t>(ModalKind::ModalCall)] = code.group;
  }
  findMasks();
  findPowerOn(dialect);
}

void ModalTable::findMasks() {
  for (std::size_t kind = 0; kind < kModalKinds; ++kind) {
    if (!kinds_[kind])
      continue;
    const auto &codes = groups_[*kinds_[kind]].codes;
    for (std::size_t i = 0; i < codes.size(); ++i)
      masks_[kind][static_cast<std::size_t>(codes[i]->action)] |= CodeMask{1} << i;
  }
}

void ModalTable::findPowerOn(const Dialect &dialect) {
  const auto take = [this](CodeAction action, bool replace) {
    for (ModalGroup &group : groups_)
      for (std::size_t i = 0; i < group.codes.size(); ++i) {
        auto &slot = powerOn_[static_cast<std::size_t>(&group - groups_.data())];
        if (group.codes[i]->action == action && (replace || !slot)) {
          slot = static_cast<std::uint8_t>(i);
          return;
        }
      }
  };
  for (const CodeAction action : kPowerOnActions)
    take(action, false);
  if (dialect.machine == MachineKind::Turning)
    for (const CodeAction action : kPowerOnTurning)
      take(action, true);
  for (const CodeAction action : dialect.behaviour.startsIn)
    take(action, true);
  for (std::size_t group = 0; group < kModalGroups; ++group) // `G67`, `G13.1`: the mode that the others leave
    for (std::size_t i = 0; i < groups_[group].codes.size() && !powerOn_[group]; ++i)
      if (const Code &code = *groups_[group].codes[i];
          code.action == CodeAction::EndOfMode || code.role == CodeRole::ModalCallCancel)
        powerOn_[group] = static_cast<std::uint8_t>(i);
}

bool ModalTable::isNeverWithout(std::size_t group) const {
  constexpr std::array kAlwaysOne = {ModalKind::Plane, ModalKind::Distance,    ModalKind::FeedMode,
                                     ModalKind::Units, ModalKind::ReturnLevel, ModalKind::WorkOffset};
  return powerOn_[group] &&
         std::any_of(kAlwaysOne.begin(), kAlwaysOne.end(), [&](ModalKind kind) { return groupOf(kind) == group; });
}

std::optional<std::uint8_t> ModalTable::indexOf(const Code &code) const {
  if (code.group == 0 || code.group >= kModalGroups)
    return std::nullopt;
  const auto &codes = groups_[code.group].codes;
  const auto found = std::find(codes.begin(), codes.end(), &code);
  if (found == codes.end())
    return std::nullopt;
  return static_cast<std::uint8_t>(found - codes.begin());
}

} // namespace feedhold
