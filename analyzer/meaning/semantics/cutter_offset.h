// CutterOffset: what the register of a D holds, for cutter compensation.
#pragma once

namespace feedhold {

/// A radius, and whether nothing says so but the tool of the contract.
template <typename N> struct CutterOffset {
  N radius{};
  bool isAssumed = false;
};

} // namespace feedhold
