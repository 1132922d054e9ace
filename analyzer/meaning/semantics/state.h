// MachineState: what the control and the machine hold between two instructions, for any interpretation.
#pragma once

#include "meaning/semantics/axes.h"
#include "meaning/semantics/modal_table.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace feedhold {

inline constexpr std::size_t kLocalVariables = 33;

/// Variables that have been written or otherwise become known, by number; the others are as at the start of the run.
template <typename Value> class VariableMap {
public:
  using Entry = std::pair<std::uint32_t, Value>;
  const Value *find(std::uint32_t number) const {
    const auto at = position(number);
    return at != entries_.end() && at->first == number ? &at->second : nullptr;
  }
  void set(std::uint32_t number, Value value) {
    const auto at = entries_.begin() + (position(number) - entries_.cbegin());
    if (at != entries_.end() && at->first == number)
      at->second = std::move(value);
    else
      entries_.insert(at, {number, std::move(value)});
  }
  void erase(std::uint32_t number) {
    const auto at = position(number);
    if (at != entries_.end() && at->first == number)
      entries_.erase(at);
  }
  /// Adds the numbers that only the other map has, each with the value that `missing` gives it.
  template <typename Missing> void addKeysOf(const VariableMap &other, Missing &&missing) {
    std::vector<Entry> added;
    auto own = entries_.cbegin();
    for (const auto &[number, value] : other.entries_) {
      while (own != entries_.cend() && own->first < number)
        ++own;
      if (own == entries_.cend() || own->first != number)
        added.emplace_back(number, missing(number));
    }
    if (added.empty())
      return;
    std::vector<Entry> all;
    all.reserve(entries_.size() + added.size());
    std::merge(std::make_move_iterator(entries_.begin()), std::make_move_iterator(entries_.end()),
               std::make_move_iterator(added.begin()), std::make_move_iterator(added.end()), std::back_inserter(all),
               [](const Entry &a, const Entry &b) { return a.first < b.first; });
    entries_ = std::move(all);
  }
  const std::vector<Entry> &entries() const { return entries_; }
  std::vector<Entry> &entries() { return entries_; }
  friend bool operator==(const VariableMap &, const VariableMap &) = default;

private:
  auto position(std::uint32_t number) const {
    return std::lower_bound(entries_.begin(), entries_.end(), number,
                            [](const Entry &entry, std::uint32_t key) { return entry.first < key; });
  }
  std::vector<Entry> entries_; // sorted by number
};

/// What a canned cycle remembers while it is active.  Z, R: levels along the normal of the plane, in work coordinates.
template <typename Value> struct CycleState {
  Value bottom;
  Value retract;
  Value initial; // level at which the cycle began: where G98 returns to
  Value peck;    // Q
  Value dwell;   // P
  friend bool operator==(const CycleState &, const CycleState &) = default;
};

/// What TransformState::other holds: a mode that is told by the code of its group, or one that is taken to last.
inline constexpr int kModalGeometry = 1;
inline constexpr int kLastingGeometry = 2;

/// Mappings between programmed and work coordinates (G51.1, G51, G68, G16), in the order in which the control applies
/// them: polar, scaling, rotation, mirror.
template <typename Value> struct TransformState {
  std::array<Value, kAxisCount> scale; // 1: not scaled
  std::array<Value, kAxisCount> scaleCentre;
  std::array<Value, kAxisCount> mirrorAt; // vacant: not mirrored
  Value angle;                            // degrees, counterclockwise
  std::array<Value, 2> centre;            // of the rotation, in the plane of G68: scaled, not mirrored
  /// Where the control may still take an axis to be: its programmed coordinate before the mappings changed, until an
  /// absolute word names the axis; vacant: where it is.
  std::array<Value, kAxisCount> pending;
  Value other; // a mode that is not followed has given movements another meaning; vacant: none since the start
  friend bool operator==(const TransformState &, const TransformState &) = default;
};

/// What a block may leave out of the two axes of the plane (kept_words.h): the coordinates before the mappings, under
/// G16 a radius above 0 and an angle.  Vacant: that is not known, or nothing of the kind is in force.
template <typename Value> struct KeptWords {
  Value first;
  Value second;
  friend bool operator==(const KeptWords &, const KeptWords &) = default;
};

/// A line with `,C` or `,R` that waits for the next one (corners.h).
template <typename Value> struct CornerState {
  Value chamfer; // one of the two; vacant: the other, or no line waits
  Value radius;
  std::array<Value, 2> start; // of the line, in the plane
  friend bool operator==(const CornerState &, const CornerState &) = default;
};

/// A macro that is called after each movement (G66) or at each block (G66.1).
template <typename Value> struct ModalCallState {
  std::uint32_t file;                            // of the block with G66
  std::uint32_t call;                            // CallId in that file
  Value repeats;                                 // L
  std::array<Value, kLocalVariables + 1> locals; // kept from one call to the next
  friend bool operator==(const ModalCallState &, const ModalCallState &) = default;
};

/// The addresses whose last word stays in force (#4102 to #4120).  No string_view: the literal of one in a header need
/// not be the same object in all translation units, and a loop over it may then begin in one and look for the end of
/// another.
inline constexpr std::array kModalWords = {'F', 'S', 'T', 'D', 'H', 'E', 'B', 'P'}; // P: of G54.1, G154
constexpr std::size_t indexOfModalWord(char letter) {
  std::size_t index = 0;
  while (kModalWords[index] != letter)
    ++index;
  return index;
}

template <typename R> struct MachineState {
  using Value = typename R::Value;
  using Truth = typename R::Truth;
  using ModalCode = typename R::ModalCode;

  std::array<Value, kLocalVariables + 1> locals; // of the present level; [0] is not used
  VariableMap<Value> variables;                  // all others
  /// Ranges of numbers, first and last, of which nothing is known but what `variables` has.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> havocked;
  std::array<ModalCode, kModalGroups> codes;
  std::array<Value, kAxisCount> position;      // end point of the last block: work coordinates, units in force
  std::array<Value, kModalWords.size()> words; // in force; vacant: none yet
  std::array<Value, kAxisCount> shift;         // of G92
  std::array<Value, kAxisCount> local;         // of G52
  Value lengthOffset;                          // of G43, along Z
  Truth lengthChanged;                         // the program has set or taken away a tool length
  std::array<Truth, kAxisCount> axisMoved;     // of those beside the regions: moved since the start, or perhaps
  CycleState<Value> cycle;
  TransformState<Value> transform;
  CornerState<Value> corner;
  KeptWords<Value> kept;
  Truth transformed;                             // a mapping beside those at the start of the run is or may be in force
  ModalCode spindle;                             // index into kSpindleActions
  std::vector<ModalCallState<Value>> modalCalls; // innermost last
  Truth modalCallsUnknown;                       // there may be others than those
  std::vector<std::pair<std::uint8_t, Truth>> enteredLoops; // by number of the DO
  std::vector<Value> counters;                              // by CounterId
  /// What the present level has saved (saved_modes.h): codes by modal group, words by their index.  Empty: nothing.
  std::vector<std::pair<std::uint8_t, ModalCode>> savedCodes;
  std::vector<std::pair<std::uint8_t, Value>> savedWords;
  Truth restoresModes; // when the program returns

  Value &word(char letter) { return words[indexOfModalWord(letter)]; }
  const Value &word(char letter) const { return words[indexOfModalWord(letter)]; }
  Value &at(Axis axis) { return position[indexOf(axis)]; }
  const Value &at(Axis axis) const { return position[indexOf(axis)]; }
  friend bool operator==(const MachineState &, const MachineState &) = default;
};

/// Whether the DO of a loop has been executed; `ifAbsent`: what is put into the list for a loop that is not in it.
template <typename R>
typename R::Truth &enteredLoop(MachineState<R> &state, std::uint8_t number, typename R::Truth ifAbsent) {
  auto &loops = state.enteredLoops;
  const auto at = std::lower_bound(loops.begin(), loops.end(), number,
                                   [](const auto &loop, std::uint8_t key) { return loop.first < key; });
  return at != loops.end() && at->first == number ? at->second : loops.insert(at, {number, ifAbsent})->second;
}

/// The states of the spindle: MachineState::spindle is an index of these.
inline constexpr std::array kSpindleActions = {CodeAction::SpindleStop, CodeAction::SpindleClockwise,
                                               CodeAction::SpindleCounterclockwise};

} // namespace feedhold
