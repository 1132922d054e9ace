// A block as LinuxCNC checks it before it executes anything: its words, its codes, and by which of them it will move.
#pragma once

#include "rules/motion/motion_view.h"

#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace feedhold::rules {

class NgcBlock {
public:
  /// Absent: the control is another one, the block calls a program or could not be read, or one of its codes is not in
  /// the tables: it may be remapped, and a user's own takes any words.
  static std::optional<NgcBlock> of(const MotionView &view, NodeId node);

  std::span<const Word *const> words() const { return words_; }
  const Word *find(char address) const;
  /// The word with one of the codes, in tenths.
  const Word *code(char address, std::span<const std::uint16_t> tenths) const;
  const Word *code(char address, std::initializer_list<std::uint16_t> tenths) const {
    return code(address, std::span(tenths.begin(), tenths.size()));
  }
  /// The code of the group of motion that the block states.
  const Word *motion() const { return motion_; }
  /// An axis, or a polar coordinate.
  bool namesAxes() const { return axis_ != nullptr; }
  const Word *axis() const { return axis_; }
  /// The axis words are those of G10, G28, G30, G52, G92 or G43.1: nothing moves by the motion in force.
  bool givesAxesAway() const;
  /// The block moves by the motion in force, which it does not state.
  bool movesByModal() const { return namesAxes() && !motion_ && !givesAxesAway(); }

private:
  std::vector<const Word *> words_;
  const Word *motion_ = nullptr;
  const Word *axis_ = nullptr;
};

/// The codes of motion that may be in force, in tenths; absent where some may come from before the program.
std::optional<std::vector<std::uint16_t>> motionsInForce(const MotionView &view, const AbstractState &state);

} // namespace feedhold::rules
