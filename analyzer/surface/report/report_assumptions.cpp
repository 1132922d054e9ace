// What proofs take for given, in words for those who sign: docs/soundness.md and docs/geometry.md tell the whole of it.
#include "surface/report/report_parts.h"

#include <array>

namespace feedhold::certificate {

namespace {

struct Assumption {
  std::string_view title;
  std::string_view text;
  std::string_view who;   // has to see to it
  std::string_view kinds; // of obligations that rest on it
};

constexpr std::string_view kAll = "all";
constexpr std::string_view kSpace = "keep-in, keep-out, clearance, travel";

constexpr std::array kAssumptions = {
    Assumption{"The program on the control is the one named here",
               "The bytes that the control runs, those of all programs that it calls, and its parameters are the ones "
               "whose hashes and settings this report lists.",
               "who loads the program", kAll},
    Assumption{
        "Callers keep the contract",
        "A program with a contract is proved for the calls that its contract allows. For other calls this report "
        "says nothing, unless @GUARDED is among the proved claims.",
        "who calls the program", kAll},
    Assumption{"Numbers are exact",
               "Arithmetic is that of exact numbers. Words are taken as they are written, not rounded to the least "
               "increment of the control. A claim that rounding may break is marked, where that was found.",
               "who reviews the report", kAll},
    Assumption{"The start is what the contract says",
               "Modal codes and the place of the tool at the start are those of @MODAL and @START; what a contract "
               "leaves open may be anything. No modal call is active, and no mirror, scaling or rotation.",
               "the operator, the set-up sheet", kAll},
    Assumption{
        "Nobody changes what runs",
        "At M00, M01 and #3006 the operator changes no variables; no macro interrupt (M96) is armed; no block is "
        "searched for, and no run is started in the middle of a program.",
        "the operator", kAll},
    Assumption{"M codes do not move axes",
               "M codes of the machine builder change neither variables nor positions: no tool change, pallet or "
               "swivelling table moves the axes.",
               "the machine builder", kAll},
    Assumption{"Loops may wait", "A loop that waits for an input is taken to wait for ever when nobody sets the input.",
               "who reviews the report", "loop-ends, program-ends"},
    Assumption{"Work and tool offsets",
               "Coordinates are those of the work coordinate system in force at the start. With G43 or G44 they are "
               "those of the tip of the tool. Offsets are set as the set-up sheet says.",
               "the set-up sheet, the operator", kSpace},
    Assumption{"The tool is as @TOOL says",
               "A tool turns about Z and is its cutting end with a shank of the same radius above it. Holders, spindle "
               "and fixtures count only as far as regions of the contract describe them.",
               "the set-up sheet", "keep-in, keep-out"},
    Assumption{"Rapid moves go anywhere between their ends",
               "G00 may move each axis by itself: the tool is taken to be anywhere in the box between the ends of the "
               "movement.",
               "nobody: this is on the safe side", "keep-out, clearance, travel"},
    Assumption{"Cutter compensation is not followed",
               "Movements with G41 or G42 in force are not proved: what is claimed of their space is unknown.",
               "who reviews the report", kSpace},
    Assumption{"The control keeps to the path",
               "Rounded corners in cutting mode (G64), lag of the drives, thermal growth and the bending of tool and "
               "machine are not in the proof. Contracts have to leave a margin for them.",
               "who writes the contract", kSpace},
};

} // namespace

Json assumptions() {
  Json rows = Json::array();
  for (const auto &[title, text, who, kinds] : kAssumptions)
    rows.push_back({{"id", "A-" + std::to_string(rows.size() + 1)},
                    {"title", title},
                    {"text", text},
                    {"who", who},
                    {"kinds", kinds}});
  return rows;
}

} // namespace feedhold::certificate
