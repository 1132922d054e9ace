// CutterOffset: what the register of a D holds for cutter compensation; of a lathe, that of a T word.
#pragma once

#include "meaning/semantics/tip_direction.h"

namespace feedhold {

template <typename N> struct CutterOffset {
  N radius{};
  bool isAssumed = false; // nothing says so but the tool of the contract
  TipDirection tip = {};  // of a lathe
};

} // namespace feedhold
