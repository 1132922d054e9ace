// variable-of-other-meaning: `#300=#4120 (SPINDLE TEMPERATURE)`, and `#4120` is the number of the tool.
#include "rules/comments/remarks_of_block.h"
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::rules::variable_of_other_meaning {
namespace {

constexpr std::uint32_t kFirstSystem = 1000;
constexpr std::uint32_t kPartsMade = 3901;
constexpr std::uint32_t kPartsRequired = 3902;

bool isModal(VariableRole role) { return role == VariableRole::ModalCode || role == VariableRole::ModalWord; }

/// What the variable holds, where the remark speaks of something that no such variable tells.
std::optional<std::string_view> otherMeaning(const VariableUse &use, const FileContext &context) {
  const VariableRole role = roleOf(context, *use.number);
  const std::string remark = remarksOf(context, use.block);
  const bool isMeasured =
      saysAny(remark, {"SPINDLE LOAD", "SERVO LOAD", "AXIS LOAD", "LOAD METER", "TEMPERATURE", "VIBRATION", "TORQUE"});
  // A row of the dialect for this number alone says what it is.
  const VariableRange *range = findVariable(context.dialect, *use.number);
  if (!use.write && isMeasured && range && range->first == range->last && role == VariableRole::Volatile &&
      !range->meaning.empty() &&
      !saysAny(toUpper(range->meaning), {"LOAD", "TEMPERATURE", "VIBRATION", "TORQUE", "INPUT"}))
    return range->meaning;
  if (!use.write && isMeasured && isModal(role))
    return "a code or a word that is in force, such as the number of the tool";
  if (!use.write && isMeasured && isPosition(role))
    return "a position of an axis";
  const bool isCounter = *use.number == kPartsMade || *use.number == kPartsRequired;
  if (use.write && isCounter && saysAny(remark, {"SPINDLE", "AXES", "AXIS", "OFFSET", "COOLANT", "OVERRIDE"}) &&
      !saysAny(remark, {"PART", "COUNT", "PIECE", "QTY", "QUANT", "CYCLE"}))
    return "the number of parts";
  return std::nullopt;
}

struct Place {
  std::uint32_t number;
  Span span;
  Span remark;
};

/// One finding for all variables that hold the same.
void tell(std::string_view meaning, const std::vector<Place> &places, const Reporter &reporter) {
  const Place &first = places.front();
  const bool hasArticle = meaning.starts_with("a ") || meaning.starts_with("the ");
  Diagnostic diagnostic{.message = fmt::format("`#{}` is not what the remark says: it holds {}{}", first.number,
                                               hasArticle ? "" : "the ", meaning),
                        .span = first.span,
                        .labels = {{first.remark, "the remark"}},
                        .notes = {"find the variable in the manual of the machine builder, or correct the remark"}};
  for (std::size_t i = 1; i < places.size(); ++i)
    diagnostic.labels.push_back({places[i].span, fmt::format("nor `#{}`", places[i].number)});
  reporter.report(std::move(diagnostic));
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  std::map<std::string_view, std::vector<Place>> found;
  for (const VariableUse &use : context.model.variablesOf(program)) {
    if (!use.number || *use.number < kFirstSystem || context.tree.blocks[use.block].has(Block::kBroken))
      continue;
    const auto meaning = otherMeaning(use, context);
    if (!meaning)
      continue;
    auto &places = found[*meaning];
    if (std::ranges::find(places, *use.number, &Place::number) == places.end())
      places.push_back({*use.number, context.tree.expressions[use.expression].span,
                        context.tree.commentsOf(use.block).front().span});
  }
  for (const auto &[meaning, places] : found)
    tell(meaning, places, reporter);
}

} // namespace

extern const Rule variableOfOtherMeaning;
const Rule variableOfOtherMeaning{
    .info = {"variable-of-other-meaning", Category::Comment, Severity::Warning,
             "Reports a system variable that the remark beside it takes for something else."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::variable_of_other_meaning
