// radius-of-diameter: `#100=60.(LARGE DIAMETER)`, and `#121=#100(START RADIUS)`.
#include "rules/comments/remarks_of_block.h"

#include <fmt/format.h>

#include <map>
#include <optional>

namespace feedhold::rules::radius_of_diameter {
namespace {

enum class Size : std::uint8_t { Radius, Diameter };

/// What the remark of an assignment says that its variable is; absent: neither, or both.
std::optional<Size> sizeIn(std::string_view remark) {
  const bool radius = saysAny(remark, {"RADIUS", "RAYON", "RADIO ", "RADIO)", "RAIO", "RAGGIO"});
  const bool diameter = saysAny(remark, {"DIAMET", "DURCHMESSER", "DIÁMET"});
  if (radius == diameter)
    return std::nullopt;
  return radius ? Size::Radius : Size::Diameter;
}

/// The only statement of a block with one remark.
const Assignment *assignmentIn(BlockId block, const FileContext &context) {
  const auto statements = context.tree.statementsOf(block);
  return statements.size() == 1 && context.tree.commentsOf(block).size() == 1
             ? std::get_if<Assignment>(&statements.front().node)
             : nullptr;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  struct Named {
    Size size;
    BlockId block;
  };
  std::map<std::uint32_t, Named> known; // by the remark of the last assignment
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    const Assignment *assignment = assignmentIn(block, context);
    const auto target =
        assignment ? variableNumber(context.tree, unwrapped(context.tree, assignment->target)) : std::nullopt;
    if (!target)
      continue;
    const auto size = sizeIn(remarksOf(context, block));
    const auto source = variableNumber(context.tree, unwrapped(context.tree, assignment->value));
    const auto from = source ? known.find(*source) : known.end();
    if (size && from != known.end() && from->second.size != *size) {
      const bool isRadius = *size == Size::Radius;
      reporter.report(
          {.message = fmt::format("by its remark this is a {}, and {} is a {}", isRadius ? "radius" : "diameter",
                                  context.quoted(context.tree.expressions[assignment->value].span),
                                  isRadius ? "diameter" : "radius"),
           .span = context.tree.blocks[block].span(),
           .labels = {{context.tree.blocks[from->second.block].span(), "set here"}},
           .notes = {isRadius ? "divide it by 2, or correct one of the remarks"
                              : "multiply it by 2, or correct one of the remarks"}});
    }
    if (size)
      known.insert_or_assign(*target, Named{*size, block});
    else
      known.erase(*target);
  }
}

} // namespace

extern const Rule radiusOfDiameter;
const Rule radiusOfDiameter{.info = {"radius-of-diameter", Category::Comment, Severity::Warning,
                                     "Reports a variable that is a radius by its remark, and a copy of one that is a "
                                     "diameter, or the other way round."},
                            .hooks = {.program = check}};

} // namespace feedhold::rules::radius_of_diameter
