// Writes benchmark programs line by line from a fixed seed.
#include "bench/generate.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace feedhold::bench {

namespace {

constexpr std::size_t kPlainProgramLines = 20000;
constexpr std::size_t kFragmentLines = 50;

/// Marsaglia's xorshift: small, and the same everywhere.
class Dice {
public:
  std::uint32_t below(std::uint32_t limit) {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_ % limit;
  }

private:
  std::uint32_t state_ = 20260101;
};

class Writer {
public:
  explicit Writer(std::size_t lines) { text_.reserve(lines * 24); }

  template <typename... Args> void line(fmt::format_string<Args...> format, Args &&...args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_ += '\n';
    ++lines_;
  }
  std::size_t lines() const { return lines_; }
  std::string take() { return std::move(text_); }

private:
  std::string text_;
  std::size_t lines_ = 0;
};

double millimetres(Dice &dice, std::uint32_t range) { return static_cast<double>(dice.below(range * 1000)) / 1000; }

void plainHead(Writer &out, std::size_t program) {
  out.line("O{:04}(POCKET {})", 1000 + program, program);
  out.line("G17 G21 G40 G49 G80 G90");
  out.line("T1 M6");
  out.line("G0 G54 X0. Y0. S4500 M3");
  out.line("G43 H1 Z25. M8");
  out.line("G1 Z-2.5 F300.");
}

/// One line of a tool path; an arc is a half circle, so that every interpreter accepts it.
void plainLine(Writer &out, Dice &dice) {
  const std::uint32_t choice = dice.below(100);
  const double x = millimetres(dice, 200);
  const double y = millimetres(dice, 150);
  if (choice < 70) {
    out.line("X{:.3f} Y{:.3f}", x, y);
  } else if (choice < 85) {
    out.line("G1 X{:.3f} Y{:.3f} Z-{:.3f} F{}.", x, y, millimetres(dice, 5), 200 + dice.below(800));
  } else if (choice < 94) {
    const std::uint32_t radius = 1 + dice.below(9);
    out.line("G91 G{} X{}. Y0. I{}. J0.", 2 + dice.below(2), 2 * radius, radius);
    out.line("G90 G1 X{:.3f} Y{:.3f}", x, y);
  } else {
    out.line("G0 Z5.");
    out.line("X{:.3f} Y{:.3f}", x, y);
    out.line("G1 Z-{:.3f} F250.", millimetres(dice, 5));
  }
}

void plainEnd(Writer &out) {
  out.line("G0 Z50. M9");
  out.line("G28 G91 Z0. M5");
  out.line("G90");
  out.line("M30");
}

std::string plain(std::size_t lines, std::size_t programLines) {
  Writer out(lines);
  Dice dice;
  out.line("%");
  for (std::size_t program = 0; out.lines() < lines; ++program) {
    const std::size_t last = std::min(lines, out.lines() + programLines);
    plainHead(out, program);
    while (out.lines() < last)
      plainLine(out, dice);
    plainEnd(out);
  }
  out.line("%");
  return out.take();
}

/// Some fifty lines around one loop and one jump; `label` and the next one are its sequence numbers.
void macroFragment(Writer &out, Dice &dice, std::size_t label) {
  const std::uint32_t common = 100 + dice.below(40);
  out.line("(FEATURE {})", label);
  out.line("#{}=#{}+{:.3f}", common, common + 1, millimetres(dice, 50));
  out.line("IF[#{}EQ#0]GOTO{}", 1 + dice.below(26), label + 1);
  out.line("#10=[#7*COS[#1]+#8*SIN[#1]]/2.");
  out.line("#11=SQRT[#10*#10+#{}*#{}]", common, common);
  out.line("IF [#11 GT {:.3f}] THEN #11={}.", millimetres(dice, 90), dice.below(90));
  out.line("#12=FIX[#11/#9]*ROUND[ABS[#4]]");
  out.line("#13=0");
  out.line("WHILE[#13LT{}]DO1", 10 + dice.below(90));
  out.line("#14=[#13*360./#12]+ATAN[#5]/[#6]");
  out.line("G01X[#24+#10*COS[#14]]Y[#25+#10*SIN[#14]]Z-#26F#9");
  for (std::size_t move = 0; move < kFragmentLines - 20; ++move)
    out.line("#{}=#{}+[#{}-{:.3f}]*{}", 110 + dice.below(30), 140 + dice.below(9), 1 + dice.below(32),
             millimetres(dice, 20), 1 + dice.below(9));
  out.line("#13=#13+1");
  out.line("END1");
  out.line("G65P9810X#24Y-#25Z[#26-{}.]F#9R2.", 1 + dice.below(9));
  out.line("N{}G00Z#18", label);
  out.line("#[500+#13]=#{}", common);
  out.line("IF[#13GE{}]GOTO{}", dice.below(50), label + 1);
  out.line("#{}=#[500+#13]", common + 2);
  out.line("N{}G90", label + 1);
}

std::string macro(std::size_t lines, std::size_t fragments) {
  Writer out(lines);
  Dice dice;
  out.line("%");
  for (std::size_t program = 0; out.lines() < lines; ++program) {
    out.line("O{}(CYCLE {})", 1001 + program, program);
    for (std::size_t fragment = 0; fragment < fragments && out.lines() < lines; ++fragment)
      macroFragment(out, dice, 2 * fragment + 1);
    out.line("M99");
  }
  out.line("%");
  return out.take();
}

} // namespace

std::optional<InputKind> inputKindFromName(std::string_view name) {
  if (name == "plain")
    return InputKind::Plain;
  if (name == "macro")
    return InputKind::Macro;
  if (name == "plain-long")
    return InputKind::PlainLong;
  if (name == "macro-long")
    return InputKind::MacroLong;
  return std::nullopt;
}

std::string generate(InputKind kind, std::size_t lines) {
  switch (kind) {
  case InputKind::Plain: return plain(lines, kPlainProgramLines);
  case InputKind::Macro: return macro(lines, 2);
  case InputKind::PlainLong: return plain(lines, lines);
  case InputKind::MacroLong: return macro(lines, lines);
  }
  return {};
}

} // namespace feedhold::bench
