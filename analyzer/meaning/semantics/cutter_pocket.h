// CutterPath::takePocket: the offset of D that a circular pocket takes itself (circle_pocket.h).
#pragma once

#include "meaning/semantics/cutter_path.h"

namespace feedhold {

/// A cycle that takes the offset itself, begins and ends without compensation, and has no corners: each of its points
/// lies on a line from the centre along the first axis, or about the centre.
template <typename Host>
void CutterPath<Host>::takePocket(Host &host, const Block &block, const At &at, std::size_t end) {
  std::string_view why = block.whyNoRadius;
  for (std::size_t i = at.move; why.empty() && i < end; ++i)
    if (host.moveOf(i).kind == MoveKind::Unmodelled)
      why = block.pocket;
  if (const std::string_view open = host.takeUndecided(); why.empty())
    why = open;
  if (why.empty() && block.side && (block.side->sign > 0 || block.side->isOfEitherSign))
    why = "a circular pocket with an offset that is, or may be, below 0";
  const bool isInside = phase_ != Phase::Off || block.isInCompensation;
  if (isInside)
    why = "a circular pocket under cutter compensation";
  if (phase_ == Phase::Off) {
    began_ = at.place;
    plane_ = block.plane;
  }
  if (!why.empty()) {
    lose(host, why, at.place);
    for (std::size_t i = at.move; i < end; ++i)
      host.leave(i, why);
    if (!isInside)
      phase_ = Phase::Off;
    return;
  }
  const Vector offset{block.side ? -block.side->radius : N{}, {}};
  for (std::size_t i = at.move; i < end; ++i) {
    const MoveOf &programmed = host.moveOf(i);
    const auto leaves = [&] { // the radius of the circle is larger than the offset
      return host.lengthOf(programmed.end[indexOf(plane_.axes.first)]) - host.lengthOf(programmed.firstCentre) +
             offset.first;
    };
    if (programmed.offsetsEnd &&
        stopsWhere(host, host.notPositive(leaves(), kStanding), AlarmKind::CutterInterference, at))
      return;
    follow(host, i,
           {shifted(host, programmed, programmed.offsetsStart ? offset : Vector{},
                    programmed.offsetsEnd ? offset : Vector{})});
  }
}

} // namespace feedhold
