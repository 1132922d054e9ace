// What every Macro B control shares: letters of arguments, operators, functions, formats of addresses.
#pragma once

#include "language/dialect/dialect.h"

#include <array>

namespace feedhold {

/// Argument assignment I: the local variable that each letter sets.  G, L, N, O and P never are arguments.
inline constexpr std::array<std::uint8_t, 26> kArgumentVariables = {
    /*A*/ 1, 2, 3, 7,        8,  9,  /*G*/ 0, 11, 4,  5,  6,  /*L*/ 0, 13,
    /*N*/ 0, 0, 0, /*Q*/ 17, 18, 19, 20,      21, 22, 23, 24, 25,
    /*Z*/ 26};

/// Functions bind tightest (they are brackets of their own); AND stands with the multiplications, OR with the sums.
inline constexpr std::array kOperators = {
    Operator{OperatorKind::Multiply, 3},    Operator{OperatorKind::Divide, 3},
    Operator{OperatorKind::Modulo, 3},      Operator{OperatorKind::And, 3},
    Operator{OperatorKind::Add, 2},         Operator{OperatorKind::Subtract, 2},
    Operator{OperatorKind::Or, 2},          Operator{OperatorKind::Xor, 2},
    Operator{OperatorKind::Equal, 1},       Operator{OperatorKind::NotEqual, 1},
    Operator{OperatorKind::GreaterThan, 1}, Operator{OperatorKind::GreaterOrEqual, 1},
    Operator{OperatorKind::LessThan, 1},    Operator{OperatorKind::LessOrEqual, 1},
};

inline constexpr std::array kBasicFunctions = {
    Function{FunctionKind::Sin},
    Function{FunctionKind::Cos},
    Function{FunctionKind::Tan, FunctionForm::OneArgument, FunctionDomain::NotPole},
    Function{FunctionKind::Asin, FunctionForm::OneArgument, FunctionDomain::MinusOneToOne},
    Function{FunctionKind::Acos, FunctionForm::OneArgument, FunctionDomain::MinusOneToOne},
    Function{FunctionKind::Atan, FunctionForm::OneOrTwo},
    Function{FunctionKind::Sqrt, FunctionForm::OneArgument, FunctionDomain::NotNegative},
    Function{FunctionKind::Abs},
    Function{FunctionKind::Round},
    Function{FunctionKind::Fix},
    Function{FunctionKind::Fup},
    Function{FunctionKind::Ln, FunctionForm::OneArgument, FunctionDomain::Positive},
    Function{FunctionKind::Exp, FunctionForm::OneArgument, FunctionDomain::Exponent},
    Function{FunctionKind::Bin, FunctionForm::OneArgument, FunctionDomain::Bcd},
    Function{FunctionKind::Bcd, FunctionForm::OneArgument, FunctionDomain::NotNegative},
};

/// Formats that the controls share; `machine` decides on E, H, U, V and W.
inline constexpr std::array<AddressFormat, 26> addressesOf(MachineKind machine) {
  constexpr AddressFormat kLength{AddressKind::Length, true, 8};
  constexpr AddressFormat kAngle{AddressKind::Angle, true, 8};
  constexpr AddressFormat kFlexible{AddressKind::Flexible, true, 8};
  const auto integer = [](std::uint8_t digits) { return AddressFormat{AddressKind::Integer, false, digits}; };
  std::array<AddressFormat, 26> formats{};
  const auto set = [&formats](char address, AddressFormat format) {
    formats[static_cast<std::size_t>(address - 'A')] = format;
  };
  for (const char address : {'X', 'Y', 'Z', 'I', 'J', 'K', 'U', 'V', 'W'})
    set(address, kLength);
  for (const char address : {'A', 'B', 'C'})
    set(address, kAngle);
  for (const char address : {'E', 'Q', 'R'})
    set(address, kFlexible);
  set('P', {AddressKind::Flexible, false, 8});
  set('F', {AddressKind::Rate, true, 8});
  set('G', {AddressKind::Integer, true, 4}); // G54.1; G1902 and the like have four digits
  set('M', integer(8));                      // three digits on most machines, a parameter allows eight
  set('S', {AddressKind::Integer, true, 8}); // with a point by option
  set('T', integer(8));
  set('D', integer(4));
  // On a lathe H is the incremental word of the C axis.
  set('H', machine == MachineKind::Turning ? AddressFormat{AddressKind::Flexible, true, 8} : integer(4));
  set('L', integer(8));
  set('N', integer(8));
  set('O', integer(8));
  return formats;
}

} // namespace feedhold
