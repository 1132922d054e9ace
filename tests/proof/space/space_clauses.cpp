#include "proof/space/space_clauses.h"

#include <cmath>
#include <fmt/format.h>

namespace feedhold::proof_tests {

using soundness::Random;

namespace {

class Writer {
public:
  Writer(Random &random, std::string_view name, const geometry::Point<double> &way)
      : random_(random), name_(name), way_(way) {}

  OpenClause run() {
    using enum OpenClause::Larger;
    switch (random_.below(12)) {
    case 0: return {"(@CLEARANCE Z" + plainSize() + ")", Tighter};
    case 1: return {"(@TRAVEL " + sides() + ")", Freer};
    case 2: return {keepOut("BOX " + wall()), Tighter};
    case 3:
    case 4:
    case 5:
    case 6:
      centre_ = random_.oneIn(2) ? std::array<std::string, 3>{"0", "0", "0"} : near(0.5);
      return leastSize({random_.oneIn(5) ? twoParts() : fmt::format("(@KEEPIN {} {})", name_, shape()), Freer});
    default: centre_ = near(6); return {keepOut(shape()), Tighter, 0.2};
    }
  }

private:
  std::string pick(std::initializer_list<const char *> choices) { return random_.of<const char *>(choices); }
  std::string keepOut(const std::string &shape) const { return fmt::format("(@KEEPOUT {} {})", name_, shape); }

  /// One region of two boxes that overlap.
  std::string twoParts() {
    return fmt::format("(@KEEPIN {0} BOX X..{1} Y{2}..{3})\n(@KEEPIN {0} BOX X{4}.. Y{2}..{3})", name_, times(0, ".5"),
                       less(1), more(1), times(0, "-.5"));
  }
  OpenClause leastSize(OpenClause clause) const {
    if (size_ == "[@@]")
      clause.least = 0.2;
    return clause;
  }

  // ---- numbers ----

  std::string plainSize() { return random_.oneIn(2) ? "[@@]" : "[@@+" + argument() + "]"; }
  std::string argument() { return pick({"#1", "#2", "#3", "#1/2", "#3*2", "#1*#2", "ABS[#1-#2]"}); }
  /// The same throughout a shape.
  const std::string &size() {
    if (size_.empty())
      size_ = plainSize();
    return size_;
  }
  std::string on(std::size_t axis) const { return centre_[axis]; }
  std::string less(std::size_t axis) { return fmt::format("[{}-{}]", on(axis), size()); }
  std::string more(std::size_t axis) { return fmt::format("[{}+{}]", on(axis), size()); }
  std::string times(std::size_t axis, const char *factor) {
    return fmt::format("[{}+{}*{}]", on(axis), size(), factor);
  }
  std::array<std::string, 3> near(double away) {
    std::array<std::string, 3> point;
    for (std::size_t i = 0; i < 3; ++i) {
      const double beside = (static_cast<double>(random_.below(17)) / 8 - 1) * away;
      const double at = std::clamp(std::round((way_[i] + beside) * 4) / 4, -100.0, 100.0);
      point[i] = random_.oneIn(5) ? fmt::format("[{}+[{}]]", argument(), at - 2) : fmt::format("[{}]", at);
    }
    return point;
  }

  // ---- shapes ----

  std::string wall() {
    const char *axis = pick1({"X", "Y", "Z"});
    return random_.oneIn(2) ? fmt::format("{}..[{}]", axis, plainSize()) : fmt::format("{}[0-{}]..", axis, plainSize());
  }
  const char *pick1(std::initializer_list<const char *> choices) { return random_.of<const char *>(choices); }
  std::string sides() {
    std::string text;
    constexpr std::array<const char *, 3> kAxes{"X", "Y", "Z"};
    for (std::size_t i = 0; i < 3; ++i)
      if (i == 2 || !random_.oneIn(4))
        text += fmt::format("{}{}..{} ", kAxes[i], less(i), random_.oneIn(6) ? "" : more(i));
    text.pop_back();
    return text;
  }
  /// From below upwards, without an end or with one.
  std::string height() {
    switch (random_.below(4)) {
    case 0: return "Z-60..60";
    case 1: return "Z" + less(2) + "..";
    case 2: return "Z.." + more(2);
    default: return fmt::format("Z{}..{}", less(2), more(2));
    }
  }
  std::string shape() {
    switch (random_.below(9)) {
    case 0:
    case 1: return "BOX " + sides();
    case 2:
    case 3: return fmt::format("CYLINDER AT X{} Y{} RADIUS {} {}", on(0), on(1), size(), height());
    case 4: return lying();
    case 5: return fmt::format("SPHERE AT X{} Y{} Z{} RADIUS {}", on(0), on(1), on(2), size());
    case 6: return "POLYGON " + (random_.oneIn(2) ? convex() : notConvex()) + " " + height();
    case 7: return "POLYGON " + convex() + " " + height();
    default: return "WHERE " + condition();
    }
  }
  std::string lying() {
    const bool alongX = random_.oneIn(2);
    const std::string along =
        random_.oneIn(3) ? ""
                         : fmt::format(" {}{}..{}", alongX ? "X" : "Y", less(alongX ? 0 : 1), more(alongX ? 0 : 1));
    return fmt::format("CYLINDER AXIS {} AT {}{} Z{} RADIUS {}{}", alongX ? "X" : "Y", alongX ? "Y" : "X",
                       on(alongX ? 1 : 0), on(2), size(), along);
  }
  std::string corner(const char *x, const char *y) { return fmt::format("X{} Y{}", times(0, x), times(1, y)); }
  std::string convex() {
    switch (random_.below(4)) {
    case 0:
      return corner("-1", "-1") + " / " + corner("1", "-1") + " / " + corner("1", "1") + " / " + corner("-1", "1");
    case 1: return corner("-1", "-1") + " / " + corner("0", "1.5") + " / " + corner("1", "-1");
    case 2: return corner("1", "0") + " / " + corner("0", "1") + " / " + corner("-1", "0") + " / " + corner("0", "-1");
    default:
      return corner("-1", "-1") + " / " + corner(".5", "-1.5") + " / " + corner("1.5", ".5") + " / " +
             corner(".5", "1") + " / " + corner("-1", ".5");
    }
  }
  std::string notConvex() {
    if (random_.oneIn(2)) // a notch from above
      return corner("-1", "-1") + " / " + corner("1", "-1") + " / " + corner("1", "1") + " / " + corner("0", ".25") +
             " / " + corner("-1", "1");
    return corner("-1", "-1") + " / " + corner("-1", "2") + " / " + corner(".5", "2") + " / " + corner(".5", ".5") +
           " / " + corner("2", ".5") + " / " + corner("2", "-1"); // an L
  }
  std::string condition() {
    const std::string x = fmt::format("[X-{}]", on(0)), y = fmt::format("[Y-{}]", on(1)),
                      z = fmt::format("[Z-{}]", on(2));
    switch (random_.below(4)) {
    case 0: return fmt::format("[{0}*{0}+{1}*{1} LE {2}*{2}] AND [{3} GE 0-{2}]", x, y, size(), z);
    case 1: return fmt::format("[ABS{}+ABS{} LE {}] AND [{} LE {}]", x, y, size(), z, size());
    case 2: return fmt::format("[SQRT[{0}*{0}+{1}*{1}] LE {2}+{3}] AND [{2}+{3} GE 0]", x, y, z, size());
    default: return fmt::format("[{0}+{1}/2 LE {2}] AND [{0} GE 0-{2}] AND [{3} GE 0-{2}*2]", x, y, size(), z);
    }
  }

  Random &random_;
  std::string_view name_;
  geometry::Point<double> way_;
  std::array<std::string, 3> centre_{"0", "0", "0"};
  std::string size_;
};

} // namespace

std::string OpenClause::with(double number) const {
  std::string result = text;
  for (std::size_t at = result.find("@@"); at != std::string::npos; at = result.find("@@", at))
    result.replace(at, 2, fmt::format("{:.4f}", number));
  return result;
}

OpenClause openClause(Random &random, std::string_view name, const geometry::Point<double> &way) {
  return Writer(random, name, way).run();
}

} // namespace feedhold::proof_tests
