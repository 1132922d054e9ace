// OperationMemo: the results of the last operations on numbers.
//
// A loop is gone through several times, and nearly all that it computes is each time the same: operands that are copies
// of those of last time have the result of last time.
#pragma once

#include "inference/domain/value.h"

#include <cstdint>
#include <vector>

namespace feedhold {

enum class NumberOperation : std::uint8_t {
  None,
  OrZero, // that number, or 0
  Add,
  Subtract,
  Multiply,
  Divide,
  Negate,
  Remainder,
  Fix,
  Fup,
  Floor,
  Ceiling,
  Round,
  RoundTo,
  Atan2,
  Power,
  Held, // read or written by a control with mantissas of 32 bits, and its sums and differences
  HeldSum,
  HeldDifference,
  FirstFunction, // and one for each FunctionKind
};

class OperationMemo {
public:
  /// compute(): the result, of these operands always the same.
  template <typename Compute>
  const AbstractNumber &of(NumberOperation operation, const AbstractNumber &left, const AbstractNumber &right,
                           Compute &&compute) {
    if (results_.empty())
      results_.resize(std::size_t{1} << kResultBits);
    const std::uint64_t key = left.hash() * 3 + right.hash() + static_cast<std::uint64_t>(operation);
    Result &known = results_[slotOf(key, kResultBits)];
    if (known.operation != operation || !known.left.isCopyOf(left) || !known.right.isCopyOf(right))
      known = {left, right, compute(), operation};
    return known.number;
  }

  /// Of a constant with these bits.
  template <typename Compute> const AbstractValue &constant(std::uint64_t bits, std::uint8_t kind, Compute &&compute) {
    if (constants_.empty())
      constants_.resize(std::size_t{1} << kConstantBits);
    Constant &known = constants_[slotOf(bits + kind, kConstantBits)];
    if (!known.isSet || known.bits != bits || known.kind != kind)
      known = {bits, kind, true, compute()};
    return known.value;
  }

private:
  static constexpr unsigned kResultBits =
      10; // a program of a hundred statements has as many results, and some constants
  static constexpr unsigned kConstantBits = 8;
  /// The highest bits of a product depend on all bits of the key (Knuth, The Art of Computer Programming 3, 6.4).
  static std::size_t slotOf(std::uint64_t key, unsigned bits) {
    return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15ULL >> (64 - bits));
  }

  struct Result {
    AbstractNumber left;
    AbstractNumber right;
    AbstractNumber number;
    NumberOperation operation = NumberOperation::None;
  };
  struct Constant {
    std::uint64_t bits = 0;
    std::uint8_t kind = 0;
    bool isSet = false;
    AbstractValue value;
  };
  std::vector<Result> results_; // empty until the first is asked for
  std::vector<Constant> constants_;
};

} // namespace feedhold
