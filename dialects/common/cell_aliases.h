// Numbers of variables that name one cell of a control.  Sources: parity.md of each dialect.
#pragma once

#include "dialects/common/tables.h"

namespace feedhold {

/// `count` cells in a row under two numbers.
consteval CellAlias sameCells(std::uint32_t first, std::uint32_t count, std::uint32_t cell, AliasWhen when) {
  return {first, first + count - 1, count, count, cell, 0, 1, when};
}

/// Tool offsets beyond 200 have numbers from #10000 on, and so have the first 200.  The offsets of the first four axes
/// are #2500 to #2806, too, where these are no tool offsets.
inline constexpr std::array kFanucMillingAliases = {
    sameCells(10001, 200, 2001, AliasWhen::Always),
    sameCells(11001, 200, 2201, AliasWhen::Always),
    sameCells(12001, 200, 2401, AliasWhen::WithV15),
    sameCells(13001, 200, 2601, AliasWhen::WithV15),
    CellAlias{2500, 2806, 100, 7, 5201, 1, 20, AliasWhen::WithoutV15},
    sameCells(14001, 960, 7001, AliasWhen::Always),
};

inline constexpr std::array kFanucTurningAliases = {
    sameCells(10001, 99, 2001, AliasWhen::Perhaps), sameCells(11001, 99, 2101, AliasWhen::Perhaps),
    sameCells(12001, 99, 2201, AliasWhen::Perhaps), sameCells(13001, 99, 2301, AliasWhen::Perhaps),
    sameCells(14001, 49, 2401, AliasWhen::Perhaps), sameCells(15001, 99, 2701, AliasWhen::Perhaps),
    sameCells(16001, 99, 2801, AliasWhen::Perhaps), sameCells(17001, 99, 2901, AliasWhen::Perhaps),
    sameCells(19001, 49, 2451, AliasWhen::Perhaps),
};

/// By axis: 50 numbers for each system instead of 20, the same names (`_WZG54[n]`, `_WZP1[n]`).
inline constexpr std::array kFanucAxisAliases = {
    CellAlias{100301, 100650, 50, 20, 5201, 20, 1, AliasWhen::Always},
    CellAlias{101001, 103400, 50, 20, 7001, 20, 1, AliasWhen::Always},
    CellAlias{103401, 116000, 50, 20, 14961, 20, 1, AliasWhen::Always},
};

inline constexpr std::array kMitsubishiAliases = {
    sameCells(10001, 200, 2001, AliasWhen::Perhaps),  sameCells(11001, 200, 2201, AliasWhen::Perhaps),
    sameCells(12001, 200, 2401, AliasWhen::Perhaps),  sameCells(13001, 200, 2601, AliasWhen::Perhaps),
    sameCells(101001, 960, 7001, AliasWhen::Perhaps),
};

inline constexpr std::array kHaasAliases = {sameCells(14001, 400, 7001, AliasWhen::Always)};
/// The new numbers of the older variables; whether #10000 or #10100 is #100 is not told clearly.
inline constexpr std::array kHaasNgcAliases = joined(kHaasAliases, std::array{
                                                                       sameCells(10000, 50, 100, AliasWhen::Perhaps),
                                                                       sameCells(10100, 900, 100, AliasWhen::Perhaps),
                                                                       sameCells(12000, 56, 1100, AliasWhen::Perhaps),
                                                                   });

/// 16 outputs on older series, 32 on newer ones.
inline constexpr std::array kOutputWords = {BitWord{1132, 1100, 16, 32}};

} // namespace feedhold
