#include "soundness/ngc_programs.h"

#include <fmt/format.h>

namespace feedhold::soundness {

namespace {

class NgcWriter {
public:
  explicit NgcWriter(Random &random) : random_(random) {}

  ProgramLines run() {
    for (int number = 1; number <= 3; ++number)
      subroutine(number);
    callees_ = 3;
    body(5 + random_.below(10), 3);
    lines_.push_back(random_.of<const char *>({"m2", "m30", "m2", "m99"}));
    if (random_.oneIn(2)) {
      lines_.push_back("o50");
      body(2, 1);
      lines_.push_back("m99");
    }
    return std::move(lines_);
  }

private:
  void say(std::string line) { lines_.push_back((random_.oneIn(20) ? "/" : "") + std::move(line)); }
  void subroutine(int number) {
    say(fmt::format("o{} sub", number));
    callees_ = number - 1; // and, seldom, itself
    body(1 + random_.below(5), 2);
    if (random_.oneIn(3))
      branchTo(random_.oneIn(2) ? fmt::format("o{} return", number)
                                : fmt::format("o{} return [{}]", number, expression(1)));
    say(fmt::format("o{} endsub", number) + (random_.oneIn(3) ? " [" + expression(1) + "]" : ""));
  }
  void body(std::uint32_t statements, int depth) {
    for (std::uint32_t i = 0; i < statements; ++i)
      statement(depth);
  }
  void statement(int depth) {
    const std::uint32_t kind = random_.below(20);
    if (kind < 6)
      return say(assignment());
    if (kind < 12)
      return say(motion());
    if (kind < 14)
      return say(mode());
    if (kind < 16)
      return call();
    if (depth == 0)
      return say(motion());
    if (kind < 18)
      return branch(depth);
    loop(depth);
  }

  // ---- expressions ----

  std::string number() {
    return random_.of<const char *>({"0",  "1",  "2",  "3",   "-1",  "-2.5", ".5",  "1.5", "0.1", ".001",
                                     "10", "90", "45", "100", "0.3", "7",    "-.1", "20",  "1e3", "0.0001"});
  }
  std::string variable() {
    if (random_.oneIn(25))
      return "#[" + expression(1) + "]";
    if (random_.oneIn(25))
      return random_.of<const char *>({"#5420",
                                       "#5421",
                                       "#5221",
                                       "#5220",
                                       "#5211",
                                       "#5061",
                                       "#5161",
                                       "#<_x>",
                                       "#<_metric>",
                                       "#<_absolute>",
                                       "#5070",
                                       "#5400",
                                       "#<_value>",
                                       "#<_call_level>",
                                       "#<_motion_mode>",
                                       "#<_plane>",
                                       "#<_abs_x>",
                                       "#<_feed>",
                                       "#<_retract_r_plane>",
                                       "#<_y>",
                                       "#<_coord_system>",
                                       "#<_value_returned>",
                                       "#<_task>",
                                       "#<_flood>"});
    return random_.of<const char *>({"#1", "#2", "#3", "#1", "#30", "#100", "#101", "#500", "#<depth>", "#<step>",
                                     "#<_speed>", "#<_total>", "#<a b>"});
  }
  std::string expression(int depth) {
    if (depth == 0 || random_.oneIn(4))
      return random_.oneIn(2) ? number() : variable();
    switch (random_.below(7)) {
    case 0: return "[" + expression(depth - 1) + "]";
    case 1: return "-" + variable();
    case 2: return function(depth - 1);
    case 3:
      return "[" + expression(depth - 1) + random_.of<const char *>({" mod ", "/", " ** "}) + expression(depth - 1) +
             "]";
    case 4: return "[" + relation() + "]";
    default:
      return "[" + expression(depth - 1) +
             random_.of<const char *>({"+", "-", "+", "-", "*", " and ", " or ", " xor "}) + expression(depth - 1) +
             "]";
    }
  }
  std::string function(int depth) {
    if (random_.oneIn(8))
      return "atan[" + expression(depth) + "]/[" + expression(depth) + "]";
    if (random_.oneIn(8))
      return random_.of<const char *>({"exists[#<depth>]", "exists[#<_speed>]", "exists[#<never>]"});
    return random_.of<const char *>({"sin", "cos", "tan", "asin", "acos", "sqrt", "abs", "ln", "exp", "fix", "fup",
                                     "round", "fix", "fup", "round", "abs"}) +
           std::string("[") + expression(depth) + "]";
  }
  std::string relation() {
    return (random_.oneIn(2) ? expression(1) : variable()) +
           random_.of<const char *>({" eq ", " ne ", " gt ", " ge ", " lt ", " le "}) + expression(1);
  }
  std::string condition() {
    if (random_.oneIn(5))
      return "[[" + relation() + "] " + random_.of<const char *>({"and", "or", "xor"}) + " [" + relation() + "]]";
    return "[" + (random_.oneIn(8) ? variable() : relation()) + "]";
  }
  std::string assignment() {
    const std::string first = variable() + "=" + expression(2);
    return random_.oneIn(6) ? first + " " + variable() + "=" + expression(1) : first;
  }

  // ---- control flow ----

  std::string label() { return fmt::format("o{}", 100 + labels_++); }
  void branchTo(std::string line) {
    const std::string name = label();
    say(name + " if " + condition());
    say(std::move(line));
    say(name + " endif");
  }
  void branch(int depth) {
    const std::string name = label();
    lines_.push_back(name + " if " + condition());
    body(1 + random_.below(2), depth - 1);
    if (random_.oneIn(3)) {
      lines_.push_back(name + " elseif " + condition());
      body(1, depth - 1);
    }
    if (random_.oneIn(2)) {
      lines_.push_back(name + " else");
      body(1 + random_.below(2), depth - 1);
    }
    lines_.push_back(name + " endif");
  }
  void loop(int depth) {
    const std::string name = label();
    const std::string counter = fmt::format("#<n{}>", labels_);
    const bool counted = !random_.oneIn(4);
    const std::string test =
        counted ? "[" + counter + " lt " + random_.of<const char *>({"3", "2.5", "#1", "10"}) + "]" : condition();
    if (counted)
      lines_.push_back(counter + "=" + random_.of<const char *>({"0", "-1", "#2"}));
    const std::uint32_t kind = random_.below(3);
    lines_.push_back(name + (kind == 0 ? " while " + test : kind == 1 ? " do" : " repeat [" + expression(1) + "]"));
    body(1 + random_.below(3), depth - 1);
    if (random_.oneIn(3))
      branchTo(name + (random_.oneIn(2) ? " break" : " continue"));
    if (counted)
      lines_.push_back(counter + "=[" + counter + "+1]");
    lines_.push_back(name + (kind == 0 ? " endwhile" : kind == 1 ? " while " + test : " endrepeat"));
  }
  void call() {
    if (random_.oneIn(12))
      return say("m98 p50" + std::string(random_.oneIn(2) ? " l2" : ""));
    const std::uint32_t callee = random_.oneIn(15) ? 1 + random_.below(4)
                                 : callees_ == 0   ? 0
                                                   : 1 + random_.below(static_cast<std::uint32_t>(callees_));
    if (callee == 0)
      return say(assignment());
    std::string arguments;
    for (std::uint32_t i = random_.below(4); i > 0; --i)
      arguments += " [" + expression(1) + "]";
    say(fmt::format("o{} call", callee) + arguments);
    if (random_.oneIn(3))
      say("#3=#<_value>");
  }

  // ---- words ----

  std::string words(std::string_view letters) {
    std::string text;
    for (const char letter : letters)
      if (random_.oneIn(2))
        text += fmt::format(" {}", letter) + (random_.oneIn(2)   ? number()
                                              : random_.oneIn(3) ? "[" + expression(1) + "]"
                                                                 : variable());
    return text;
  }
  std::string motion() {
    switch (random_.below(6)) {
    case 0: return random_.of<const char *>({"g2", "g3", "g17 g2", "g18 g3", "g90.1 g2"}) + words("xyzijk");
    case 1:
      return random_.of<const char *>({"g81", "g83", "g73", "g82", "g98 g81", "g99 g85", "g91 g81"}) + words("xyzrql");
    case 2:
      return random_.of<const char *>({"g92", "g52", "g10 l2 p1", "g10 l20 p1", "g10 l2 p2", "g92.1", "g92.2", "g92.3",
                                       "g28", "g30", "g28.1", "g43.1", "g53 g0"}) +
             words("xyz");
    default: return random_.of<const char *>({"g0", "g1", "", "", "g38.2", "g91 g1", "g90 g0"}) + words("xyz");
    }
  }
  std::string mode() {
    return random_.of<const char *>({"g90",   "g91",     "g17",   "g18", "g19",      "g20", "g21",  "g54",
                                     "g55",   "g59.1",   "g98",   "g99", "g80",      "g93", "g94",  "g49",
                                     "g90.1", "g91.1",   "g0",    "g1",  "m3 s500",  "m5",  "f100", "f#2",
                                     "s#3",   "g[#100]", "m[#2]", "g61", "g64 p0.1", "m70", "m72",  "m73"});
  }

  Random &random_;
  ProgramLines lines_;
  int labels_ = 0;
  int callees_ = 0;
};

} // namespace

ProgramLines ngcProgram(Random &random) { return NgcWriter(random).run(); }

} // namespace feedhold::soundness
