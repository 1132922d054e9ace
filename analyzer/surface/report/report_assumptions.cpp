// What the proofs assume, for those who sign the report; docs/soundness.md and docs/geometry.md have the details.
#include "surface/report/report_parts.h"

#include <array>

namespace feedhold::certificate {

namespace {

struct Assumption {
  std::string_view title;
  std::string_view text;
  std::string_view responsible;
  std::string_view kinds; // of obligations that depend on it
};

constexpr std::string_view kAll = "all";
constexpr std::string_view kSpace = "keep-in, keep-out, clearance, travel";

constexpr std::array kAssumptions = {
    Assumption{"The program on the control is the one named here",
               "The control runs the files whose hashes this report lists, called programs included, with the settings "
               "that it lists.",
               "whoever loads the program", kAll},
    Assumption{"Callers keep the contract",
               "A program with a contract is proved for the calls that its contract allows. This report says "
               "nothing about other calls, unless @GUARDED is among the proved claims.",
               "whoever calls the program", kAll},
    Assumption{"Numbers are exact",
               "The proofs use exact arithmetic. Words are taken as written, not rounded to the least increment of the "
               "control. Claims that rounding is known to endanger are marked.",
               "the reviewer of the report", kAll},
    Assumption{
        "The start is what the contract says",
        "Modal codes and tool position at the start are those of @MODAL and @START; what a contract leaves open may "
        "have any value. No modal call is active, and no mirroring, scaling or rotation.",
        "the operator, the set-up sheet", kAll},
    Assumption{
        "Nobody intervenes in the run",
        "At M00, M01 and #3006 the operator changes no variables; no macro interrupt (M96) is armed; nobody uses block "
        "search or starts in the middle of a program.",
        "the operator", kAll},
    Assumption{"M codes do not move axes",
               "M codes of the machine builder change neither variables nor positions: no tool change, pallet change "
               "or swivelling table moves an axis.",
               "the machine builder", kAll},
    Assumption{"Loops may wait",
               "A loop that waits for an input counts as endless, because nobody may ever set the input. Where "
               "@EVENTUALLY says that the input comes, the machine must bring it while the program waits.",
               "the reviewer of the report, the machine builder", "loop-ends, program-ends"},
    Assumption{
        "Work and tool offsets",
        "Coordinates refer to the work coordinate system active at the start. With G43 or G44 they refer to the tip "
        "of the tool. Offsets are set as the set-up sheet says.",
        "the set-up sheet, the operator", kSpace},
    Assumption{"The tool is as @TOOL says",
               "The tool rotates about Z. It is modelled as its cutting end with a shank of the same radius above it. "
               "Holder, spindle and fixtures count only as far as the contract describes them as regions.",
               "the set-up sheet", "keep-in, keep-out"},
    Assumption{
        "Rapid moves go anywhere between their ends",
        "G00 may move each axis independently: the tool may be anywhere in the box spanned by the two ends of the "
        "move.",
        "nobody: this assumption is conservative", "keep-out, clearance, travel"},
    Assumption{
        "The offset of D is as @OFFSET says",
        "With G41 or G42 active the path is that of the tool's centre, by the offset that @OFFSET tells for a D; "
        "without that clause the offset is the radius of @TOOL. Offsets are not changed during the run. Where the "
        "path is not followed, claims are unknown or refuted by a run.",
        "the set-up sheet, the operator", "keep-in, keep-out, clearance, compensation"},
    Assumption{"Regions are the same at every angle of the axes of @FIXED",
               "Where the contract says @FIXED, its regions are the same at every angle of these axes, and so is the "
               "tool. Without the clause, claims hold only while such axes stand where they stood at the "
               "start.",
               "the author of the contract", "keep-in, keep-out, clearance"},
    Assumption{
        "The control keeps to the path",
        "Where the contract says @CORNER, the tool leaves the programmed path by no more than that; elsewhere corner "
        "rounding in cutting mode (G64) and servo lag are not part of the proof. Nor are thermal growth and deflection "
        "of tool and machine. Contracts must leave a margin for whatever is not covered.",
        "the author of the contract", kSpace},
};

} // namespace

Json assumptions() {
  Json rows = Json::array();
  for (const auto &[title, text, responsible, kinds] : kAssumptions)
    rows.push_back({{"id", "A-" + std::to_string(rows.size() + 1)},
                    {"title", title},
                    {"text", text},
                    {"responsible", responsible},
                    {"kinds", kinds}});
  return rows;
}

} // namespace feedhold::certificate
