// ModalTable: the modal groups of a control, made from the rows of its dialect: which codes exclude one another, and in
// which group the semantics finds what it asks for.
#pragma once

#include "language/dialect/dialect.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

namespace feedhold {

inline constexpr std::size_t kModalGroups = 40;

/// Set of codes of one group, by their index in it.
using CodeMask = std::uint64_t;

struct ModalGroup {
  std::vector<const Code *> codes; // at most 64, by number
};

/// What the semantics asks of the modal state.
enum class ModalKind : std::uint8_t {
  Motion,
  Plane,
  Distance,
  ArcDistance,
  FeedMode,
  Units,
  Compensation,
  Length,
  Cycle,
  ReturnLevel,
  Scaling,
  ModalCall,
  Spindle, // G96 G97
  WorkOffset,
  Rotation,
  Polar,
  Mirror,
};
inline constexpr std::size_t kModalKinds = 17;
std::string_view nameOf(ModalKind kind);

/// The code is all that there is to the mode: a run may start in it.  Others come with words, offsets or mappings.
bool isWholeMode(CodeAction action);

class ModalTable {
public:
  explicit ModalTable(const Dialect &dialect);

  const ModalGroup &group(std::size_t number) const { return groups_[number]; }
  /// The group in which a kind of state is kept; absent where the control has none (distance of a lathe of system A).
  std::optional<std::uint8_t> groupOf(ModalKind kind) const { return kinds_[static_cast<std::size_t>(kind)]; }
  /// The codes of a kind's group that do one of the actions.
  CodeMask maskOf(ModalKind kind, std::initializer_list<CodeAction> actions) const {
    CodeMask mask = 0;
    for (const CodeAction action : actions)
      mask |= masks_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(action)];
    return mask;
  }
  /// The place of a code in its group; absent when it is not modal.
  std::optional<std::uint8_t> indexOf(const Code &code) const;
  /// What is in force at power-on, for a group of which nothing else is known; absent: no code.
  std::optional<std::uint8_t> powerOn(std::size_t group) const { return powerOn_[group]; }
  /// One of the codes that are listed is active at all times: nothing ends all modes of the group, and machine builders
  /// add none.
  bool isNeverWithout(std::size_t group) const;

private:
  void findMasks();
  void findPowerOn(const Dialect &dialect);

  std::array<ModalGroup, kModalGroups> groups_;
  std::array<std::optional<std::uint8_t>, kModalKinds> kinds_{};
  std::array<std::optional<std::uint8_t>, kModalGroups> powerOn_{};
  std::array<std::array<CodeMask, kCodeActions>, kModalKinds> masks_{};
};

} // namespace feedhold
