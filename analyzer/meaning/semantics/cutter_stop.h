// CutterPath: where it cannot go on, or does not follow.
#pragma once

#include "meaning/semantics/cutter_path.h"

namespace feedhold {

/// A corner (,C ,R) stands between two blocks of the contour.  FANUC refuses one in the blocks that begin or end the
/// compensation, or change its side (PS0039); what others make of it is not known.
template <typename Host>
void CutterPath<Host>::takeCorner(Host &host, const Block &block, bool isBehind, const At &at) {
  const bool waited = std::exchange(waits_, block.leadsToCorner);
  if (phase_ == Phase::Off || phase_ == Phase::Lost || alarm_)
    return;
  if ((isBehind || block.leadsToCorner) && phase_ != Phase::On)
    lose(host, "cutter compensation that begins or ends at a corner (,C ,R)", at.place);
  else if (waited && !isBehind)
    lose(host, kNoLine, at.place);
  else if (block.leadsToCorner && block.stopsReading)
    lose(host, "cutter compensation through a stop at a corner (,C ,R)", at.place);
}

template <typename Host> void CutterPath<Host>::finish(Host &host) {
  if (!pending_ || alarm_)
    return;
  if (waits_)
    lose(host, kNoLine, pending_->place);
  else
    failReading(host);
}

// ---- what cannot go on ----

template <typename Host> bool CutterPath<Host>::stopsWhere(Host &host, Truth when, AlarmKind kind, const At &at) {
  if (!began_ || !host.refuses(when, kind, *began_))
    return false;
  stop(host, kind, at);
  return true;
}

template <typename Host> void CutterPath<Host>::stop(Host &host, AlarmKind kind, const At &at) {
  if (pending_ && pending_->move >= at.move)
    pending_.reset();
  finish(host);
  if (!alarm_ && began_)
    alarm_ = CutterAlarm{kind, at.place, at.depth, at.move, *began_};
}

template <typename Host> void CutterPath<Host>::lose(Host &host, std::string_view reason, Place place) {
  notes_.push_back({reason, place});
  lostBy_ = reason;
  if (pending_) {
    host.leave(pending_->move, reason);
    for (const std::size_t index : pending_->behind)
      host.leave(index, reason);
  }
  pending_.reset();
  phase_ = Phase::Lost;
}

template <typename Host>
void CutterPath<Host>::loseHere(Host &host, std::string_view reason, std::size_t index, const At &at) {
  lose(host, reason, at.place);
  host.leave(index, reason);
}

} // namespace feedhold
