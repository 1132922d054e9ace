// Generated programs for the benchmarks: the same text for the same request on every machine.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold::bench {

enum class InputKind {
  Plain,     // as a CAM system writes: moves, arcs, tool changes; programs of 20 000 lines
  Macro,     // arithmetic, conditions, loops, jumps, calls; programs of some 100 lines
  PlainLong, // as Plain, all in one program
  MacroLong, // as Macro, all in one program: every label and jump in one scope
};

std::optional<InputKind> inputKindFromName(std::string_view name);

/// A file of about `lines` lines (up to a hundred more).
std::string generate(InputKind kind, std::size_t lines);

} // namespace feedhold::bench
